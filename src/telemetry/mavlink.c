/* See mavlink.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "telemetry/mavlink.h"

#define DEGREES (180 / 3.14159265358979323846)

enum
{
  MAGIC_1 = 0xfe,
  MAGIC_2 = 0xfd,
  HEADER_1 = 6,
  HEADER_2 = 10,
  CHECKSUM = 2,
  SIGNED = 1, /* the one incompatible flag that is known */
  SIGNATURE = 13,
  HIGHEST_ID = 0xffff,
  LOOKED_AHEAD = 4, /* frames */
  CELLS = 10
};

/* ---- Messages ---- */

#define BOOT_TIME                                                                                  \
  {                                                                                                \
    "time", 0, 'u', 1e-3, NAN                                                                      \
  }

static const bt__mavlink_message messages[] = {
  { "ATTITUDE",
    30,
    39,
    28,
    { BOOT_TIME,
      { "roll", 4, 'f', DEGREES, NAN },
      { "pitch", 8, 'f', DEGREES, NAN },
      { "yaw", 12, 'f', DEGREES, NAN } } },
  { "LOCAL_POSITION_NED",
    32,
    185,
    28,
    { BOOT_TIME,
      { "north", 4, 'f', 1, NAN },
      { "east", 8, 'f', 1, NAN },
      { "down", 12, 'f', 1, NAN } } },
  { "GLOBAL_POSITION_INT",
    33,
    104,
    28,
    { BOOT_TIME,
      { "lat", 4, 'i', 1e-7, NAN },
      { "lon", 8, 'i', 1e-7, NAN },
      { "alt", 12, 'i', 1e-3, NAN },
      { "relative-alt", 16, 'i', 1e-3, NAN },
      { "heading", 26, 'w', 1e-2, UINT16_MAX } } },
  { "VFR_HUD",
    74,
    20,
    20,
    { { "groundspeed", 4, 'f', 1, NAN },
      { "alt", 8, 'f', 1, NAN },
      { "climb", 12, 'f', 1, NAN },
      { "heading", 16, 's', 1, NAN } } },
  { "SCALED_PRESSURE2",
    137,
    195,
    14,
    { BOOT_TIME,
      { "pressure", 4, 'f', 100, NAN }, /* hPa to Pa */
      { "temperature", 12, 's', 1e-2, NAN } } },
  { "BATTERY_STATUS",
    147,
    154,
    36,
    { { "voltage", 10, 'c', 1e-3, NAN },
      { "current", 30, 's', 1e-2, -1 },
      { "remaining", 35, 'b', 1, -1 } } },
  { "NAMED_VALUE_FLOAT", 251, 170, 18, { BOOT_TIME, { "value", 4, 'f', 1, NAN } } },
};

static const bt__mavlink_message *
message_of (uint32_t id)
{
  for (size_t i = 0; i < sizeof messages / sizeof *messages; i++)
    if (messages[i].id == id)
      return messages + i;
  return NULL;
}

/* ---- Numbers, least byte first ---- */

static uint32_t
whole_number (const uint8_t *p, int bytes)
{
  uint32_t u = 0;
  for (int i = 0; i < bytes; i++)
    u |= (uint32_t)p[i] << 8 * i;
  return u;
}

/* The sum of the cells of a battery, mV, without the cells told to be absent.  */
static double
cells (const uint8_t *p)
{
  double sum = NAN;
  for (int i = 0; i < CELLS; i++)
    {
      uint32_t u = whole_number (p + 2 * (ptrdiff_t)i, 2);
      if (u != UINT16_MAX)
        sum = (isnan (sum) ? 0 : sum) + u;
    }
  return sum;
}

static double
payload_number (const uint8_t *p, char type)
{
  uint32_t u;
  float f;
  switch (type)
    {
    case 'u':
      return whole_number (p, 4);
    case 'i':
      return (int32_t)whole_number (p, 4);
    case 's':
      return (int16_t)whole_number (p, 2);
    case 'w':
      return whole_number (p, 2);
    case 'b':
      return (int8_t)whole_number (p, 1);
    case 'c':
      return cells (p);
    default:
      u = whole_number (p, 4);
      memcpy (&f, &u, sizeof f);
      return f;
    }
}

static double
told_value (const bt__mavlink_field *field, const uint8_t *payload)
{
  double x = payload_number (payload + field->at, field->type);
  return isfinite (x) && x != field->none ? x * field->scale : NAN;
}

/* ---- Frames ---- */

typedef struct frame
{
  size_t header, payload, size; /* bytes; the size with checksum and signature */
} frame;

static int
is_magic (uint8_t byte)
{
  return byte == MAGIC_1 || byte == MAGIC_2;
}

/* X.25 (ITU-T V.42): 0x1021 reflected, begun with ones.  */
static uint16_t
crc_over (uint16_t crc, const uint8_t *p, size_t n)
{
  for (size_t i = 0; i < n; i++)
    {
      crc ^= p[i];
      for (int k = 0; k < 8; k++)
        crc = (uint16_t)(crc & 1 ? crc >> 1 ^ 0x8408 : crc >> 1);
    }
  return crc;
}

static int
checksum_holds (const uint8_t *p, const frame *f, uint8_t extra)
{
  size_t end = f->header + f->payload;
  uint16_t crc = crc_over (crc_over (0xffff, p + 1, end - 1), &extra, 1);
  return crc == whole_number (p + end, CHECKSUM);
}

/* The header at P, of N bytes; 0 if it is not whole.  */
static int
frame_header (const uint8_t *p, size_t n, frame *f, bt__mavlink_found *found)
{
  int second = p[0] == MAGIC_2;
  f->header = second ? HEADER_2 : HEADER_1;
  if (n < f->header)
    return 0;
  f->payload = p[1];
  f->size = f->header + f->payload + CHECKSUM + (second && (p[2] & SIGNED) ? SIGNATURE : 0);
  const uint8_t *rest = p + (second ? 4 : 2);
  found->version = second ? 2 : 1;
  found->sequence = rest[0];
  found->system = rest[1];
  found->component = rest[2];
  found->id = whole_number (rest + 3, second ? 3 : 1);
  return n >= f->size;
}

/* Decode the payload; trailing zeros that version 2 left out are put back.  */
static void
decode_payload (const uint8_t *p, const frame *f, bt__mavlink_found *found)
{
  const bt__mavlink_message *m = found->message;
  uint8_t payload[UINT8_MAX + 1] = { 0 };
  memcpy (payload, p + f->header, f->payload);
  for (int i = 0; i < BT__MAVLINK_FIELDS; i++)
    found->value[i] = m->field[i].name ? told_value (m->field + i, payload) : NAN;
  if (strcmp (m->name, "NAMED_VALUE_FLOAT") == 0)
    memcpy (found->name, payload + 8, BT__MAVLINK_NAME);
}

/* The kind of a frame whose checksum cannot be known: FLAGS is true if it has flags that mean
   nothing yet.  Sender 0 is none, and no message in use has so high a number.  */
static bt__mavlink_kind
judge_unknown (const bt__mavlink_found *found, int flags)
{
  return flags || found->system == 0 || found->id > HIGHEST_ID ? BT__MAVLINK_NOISE
                                                               : BT__MAVLINK_OTHER;
}

/* What the frame is worth that begins at P, whole.  */
static bt__mavlink_kind
judge_frame (const uint8_t *p, const frame *f, bt__mavlink_found *found)
{
  const bt__mavlink_message *m = message_of (found->id);
  int flags = found->version == 2 && (p[2] & ~SIGNED);
  if (!m)
    return judge_unknown (found, flags);
  if ((found->version == 1 && f->payload < m->shortest) || !checksum_holds (p, f, m->extra))
    return BT__MAVLINK_WRONG;
  if (flags)
    return BT__MAVLINK_OTHER;
  found->message = m;
  decode_payload (p, f, found);
  return BT__MAVLINK_GOOD;
}

/* Does a frame stand at P, of N bytes, where one has ended, or nothing?  A frame that cannot be
   checked is gone past, to the first that can.  */
static int
frame_follows (const uint8_t *p, size_t n, size_t stamp)
{
  for (int k = 0; k < LOOKED_AHEAD && n > stamp; k++)
    {
      frame f;
      bt__mavlink_found next;
      if (!is_magic (p[stamp]))
        return 0;
      if (!frame_header (p + stamp, n - stamp, &f, &next))
        return 1;
      const bt__mavlink_message *m = message_of (next.id);
      if (m)
        return checksum_holds (p + stamp, &f, m->extra);
      p += stamp + f.size;
      n -= stamp + f.size;
    }
  return 1;
}

/* The frame at P, of N bytes, the first of which is a magic.  */
static void
look_at_frame (const uint8_t *p, size_t n, size_t stamp, bt__mavlink_found *found)
{
  frame f;
  if (!frame_header (p, n, &f, found))
    {
      found->kind = BT__MAVLINK_SHORT;
      return;
    }
  found->kind = judge_frame (p, &f, found);
  found->size = f.size;
  if (found->kind == BT__MAVLINK_OTHER && !frame_follows (p + f.size, n - f.size, stamp))
    found->kind = BT__MAVLINK_NOISE;
  if (found->kind == BT__MAVLINK_WRONG || found->kind == BT__MAVLINK_NOISE)
    found->size = 1; /* a good frame may begin within what only looked like one */
}

/* How many of the N bytes at P to pass over until what may be a stamp and a frame.  */
static size_t
noise_size (const uint8_t *p, size_t n, size_t stamp)
{
  size_t i = stamp + 1;
  while (i < n && !is_magic (p[i]))
    i++;
  return i - stamp;
}

void
bt__mavlink_next (const uint8_t *bytes, size_t n, size_t stamp, bt__mavlink_found *found)
{
  memset (found, 0, sizeof *found);
  if (n <= stamp)
    return;
  if (is_magic (bytes[stamp]))
    {
      look_at_frame (bytes + stamp, n - stamp, stamp, found);
      if (found->kind == BT__MAVLINK_GOOD || found->kind == BT__MAVLINK_OTHER)
        found->size += stamp;
      return;
    }
  found->kind = BT__MAVLINK_NOISE;
  found->size = noise_size (bytes, n, stamp);
}
