/* Frames of MAVLink: what each field says, the checksum against every changed bit, both versions,
   trailing zeros, signatures, and what stands between frames.

   The frames are written here by hand from the message definitions; tests/follow.sh has those of
   encoders that others wrote.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "telemetry/mavlink.h"

/* The checksum by another algorithm than the one that is tested; the check value of
   CRC-16/MCRF4XX over "123456789" is 6f91 in the catalogue of G. Cook.  */
static uint16_t
reference_crc (const uint8_t *p, size_t n)
{
  uint16_t crc = 0xffff;
  for (size_t i = 0; i < n; i++)
    {
      uint8_t t = (uint8_t)(p[i] ^ (crc & 0xff));
      t = (uint8_t)(t ^ (t << 4));
      crc = (uint16_t)((crc >> 8) ^ (t << 8) ^ (t << 3) ^ (t >> 4));
    }
  return crc;
}

static void
crc_reference (void **state)
{
  (void)state;
  assert_int_equal (reference_crc ((const uint8_t *)"123456789", 9), 0x6f91);
}

/* A frame of VERSION with the N bytes of PAYLOAD in FRAME; return its size.  */
static size_t
write_frame (int version, uint32_t id, uint8_t extra, const uint8_t *payload, size_t n,
             uint8_t *frame)
{
  size_t header = version == 1 ? 6 : 10;
  uint8_t first[] = { 0xfe, (uint8_t)n, 9, 1, 2, (uint8_t)id };
  uint8_t second[]
      = { 0xfd, (uint8_t)n, 0, 0, 9, 1, 2, (uint8_t)id, (uint8_t)(id >> 8), (uint8_t)(id >> 16) };
  memcpy (frame, version == 1 ? first : second, header);
  memcpy (frame + header, payload, n);
  frame[header + n] = extra;
  uint16_t crc = reference_crc (frame + 1, header + n);
  frame[header + n] = (uint8_t)crc;
  frame[header + n + 1] = (uint8_t)(crc >> 8);
  return header + n + 2;
}

static void
put_float (uint8_t *at, float value)
{
  uint32_t u;
  memcpy (&u, &value, sizeof u);
  for (int i = 0; i < 4; i++)
    at[i] = (uint8_t)(u >> 8 * i);
}

static const uint8_t attitude_extra = 39;

/* ATTITUDE at 2.5 s, its yaw a right angle; the rates are zeros.  */
static size_t
attitude (int version, size_t shown, uint8_t *frame)
{
  uint8_t payload[28] = { 0xc4, 0x09 };
  put_float (payload + 4, 0.5F);
  put_float (payload + 8, -0.25F);
  put_float (payload + 12, 1.57079637F);
  return write_frame (version, 30, attitude_extra, payload, shown, frame);
}

static void
check_attitude (const uint8_t *frame, size_t n, int version)
{
  bt__mavlink_found f;
  bt__mavlink_next (frame, n, 0, &f);
  assert_int_equal (f.kind, BT__MAVLINK_GOOD);
  assert_int_equal (f.size, n);
  assert_int_equal (f.version, version);
  assert_int_equal (f.sequence, 9);
  assert_int_equal (f.system, 1);
  assert_int_equal (f.component, 2);
  assert_string_equal (f.message->name, "ATTITUDE");
  const double expected[] = { 2.5, 28.64788975654116, -14.32394487827058, 90 };
  for (int i = 0; i < 4; i++)
    assert_true (fabs (f.value[i] - expected[i]) < 1e-5);
}

static void
both_versions (void **state)
{
  uint8_t frame[300];
  (void)state;
  check_attitude (frame, attitude (1, 28, frame), 1);
  check_attitude (frame, attitude (2, 28, frame), 2);
  check_attitude (frame, attitude (2, 16, frame), 2); /* trailing zeros left out */
}

/* Every changed bit behind the magic is found out: the frame is wrong, another's, or not whole.  */
static void
any_bit (void **state)
{
  uint8_t frame[300];
  (void)state;
  for (int version = 1; version <= 2; version++)
    {
      size_t n = attitude (version, 28, frame);
      for (size_t bit = 8; bit < 8 * n; bit++)
        {
          bt__mavlink_found f;
          frame[bit / 8] ^= (uint8_t)(1U << bit % 8);
          bt__mavlink_next (frame, n, 0, &f);
          assert_int_not_equal (f.kind, BT__MAVLINK_GOOD);
          frame[bit / 8] ^= (uint8_t)(1U << bit % 8);
        }
    }
}

static void
cut_anywhere (void **state)
{
  uint8_t frame[300];
  (void)state;
  for (int version = 1; version <= 2; version++)
    {
      size_t n = attitude (version, 28, frame);
      for (size_t k = 0; k < n; k++)
        {
          bt__mavlink_found f;
          bt__mavlink_next (frame, k, 0, &f);
          assert_int_equal (f.kind, BT__MAVLINK_SHORT);
          assert_int_equal (f.size, 0);
        }
    }
}

/* Version 1 leaves no zeros out: a short payload is no message, whatever its checksum.  */
static void
short_payload (void **state)
{
  uint8_t frame[300];
  bt__mavlink_found f;
  (void)state;
  bt__mavlink_next (frame, attitude (1, 16, frame), 0, &f);
  assert_int_equal (f.kind, BT__MAVLINK_WRONG);
}

static void
what_is_none (void **state)
{
  uint8_t payload[54] = { 0 }, frame[300];
  bt__mavlink_found f;
  (void)state;
  for (int i = 0; i < 20; i++)
    payload[10 + i] = 0xff; /* no cell is known */
  payload[30] = payload[31] = payload[35] = 0xff;
  bt__mavlink_next (frame, write_frame (2, 147, 154, payload, 54, frame), 0, &f);
  assert_int_equal (f.kind, BT__MAVLINK_GOOD);
  for (int i = 0; i < 3; i++)
    assert_true (isnan (f.value[i]));
  payload[10] = 0x10, payload[11] = 0x27; /* 10 V */
  payload[12] = 0xe8, payload[13] = 0x03; /* and 1 V */
  bt__mavlink_next (frame, write_frame (2, 147, 154, payload, 54, frame), 0, &f);
  assert_true (fabs (f.value[0] - 11) < 1e-9);
}

static void
names_and_infinities (void **state)
{
  uint8_t payload[18] = { 0 }, frame[300];
  bt__mavlink_found f;
  (void)state;
  put_float (payload + 4, INFINITY);
  memset (payload + 8, 'x', 10);
  bt__mavlink_next (frame, write_frame (2, 251, 170, payload, 18, frame), 0, &f);
  assert_int_equal (f.kind, BT__MAVLINK_GOOD);
  assert_string_equal (f.name, "xxxxxxxxxx");
  assert_true (isnan (f.value[1]));
}

/* A signed frame is read, its signature passed over; one with a flag that is not known is not.  */
static void
flags (void **state)
{
  uint8_t frame[300], extra = attitude_extra;
  bt__mavlink_found f;
  (void)state;
  size_t n = attitude (2, 28, frame);
  for (int flag = 1; flag <= 2; flag++)
    {
      frame[2] = (uint8_t)flag;
      frame[n - 2] = extra;
      uint16_t crc = reference_crc (frame + 1, n - 2);
      frame[n - 2] = (uint8_t)crc;
      frame[n - 1] = (uint8_t)(crc >> 8);
      memset (frame + n, 0, 13);
      bt__mavlink_next (frame, flag == 1 ? n + 13 : n, 0, &f);
      assert_int_equal (f.kind, flag == 1 ? BT__MAVLINK_GOOD : BT__MAVLINK_OTHER);
      assert_int_equal (f.size, flag == 1 ? n + 13 : n);
    }
}

/* Of a stream with noise between its frames, every frame is found, whatever the noise.  */
static void
between_frames (void **state)
{
  uint8_t bytes[4000];
  uint64_t seed = 1;
  (void)state;
  for (int turn = 0; turn < 300; turn++)
    {
      size_t n = 0, frames = 5, good = 0, stamp = turn % 2 ? BT__MAVLINK_STAMP : 0;
      for (size_t k = 0; k < frames; k++)
        {
          seed = seed * 6364136223846793005u + 1442695040888963407u;
          size_t noise = stamp + (seed >> 33) % 20;
          for (size_t i = 0; i < noise; i++)
            bytes[n++] = (uint8_t)((seed >> 20) * (i + 3) >> 3) & 0x7f; /* no magic */
          n += attitude (1 + (int)(k % 2), 28, bytes + n);
        }
      for (size_t at = 0; at < n;)
        {
          bt__mavlink_found f;
          bt__mavlink_next (bytes + at, n - at, stamp, &f);
          good += f.kind == BT__MAVLINK_GOOD;
          assert_true (f.size > 0);
          at += f.size;
        }
      assert_int_equal (good, frames);
    }
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (crc_reference),
    cmocka_unit_test (both_versions),
    cmocka_unit_test (any_bit),
    cmocka_unit_test (cut_anywhere),
    cmocka_unit_test (short_payload),
    cmocka_unit_test (what_is_none),
    cmocka_unit_test (names_and_infinities),
    cmocka_unit_test (flags),
    cmocka_unit_test (between_frames),
  };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
