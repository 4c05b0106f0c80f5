/* Frames of MAVLink, versions 1 and 2, found among bytes from anywhere, and the numbers of the
   messages by which a dive is followed.

   After the published guide "Packet Serialization" (mavlink.io) and the message definitions
   common.xml of the MAVLink project.  Nothing here writes a frame.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_TELEMETRY_MAVLINK_H
#define BT_TELEMETRY_MAVLINK_H

#include <stddef.h>
#include <stdint.h>

enum
{
  BT__MAVLINK_FIELDS = 8, /* of a message at most */
  BT__MAVLINK_NAME = 10,  /* bytes of the name that NAMED_VALUE_FLOAT carries */
  BT__MAVLINK_STAMP = 8,  /* bytes of time before each frame of a .tlog file */
  BT__MAVLINK_LONGEST = 10 + 255 + 2 + 13
};

/* What stands at the beginning of some bytes.  */
typedef enum bt__mavlink_kind
{
  BT__MAVLINK_SHORT, /* a frame that is not whole yet, or nothing */
  BT__MAVLINK_NOISE, /* bytes that belong to no frame */
  BT__MAVLINK_OTHER, /* a frame of a message that is not decoded here, its checksum unknown */
  BT__MAVLINK_WRONG, /* a frame whose checksum or length is wrong */
  BT__MAVLINK_GOOD
} bt__mavlink_kind;

/* How a field of a message is written, and in which unit it is told.  */
typedef struct bt__mavlink_field
{
  const char *name;
  uint8_t at; /* offset in the payload */
  char type;  /* f float, i int32, u uint32, s int16, w uint16, b int8, c the sum of ten uint16 */
  double scale;
  double none; /* the written number that means no value, or NAN */
} bt__mavlink_field;

typedef struct bt__mavlink_message
{
  const char *name;
  uint32_t id;
  uint8_t extra;    /* the byte that the checksum takes in besides */
  uint8_t shortest; /* bytes of the payload in version 1, without what was added later */
  bt__mavlink_field field[BT__MAVLINK_FIELDS]; /* up to the first without a name */
} bt__mavlink_message;

typedef struct bt__mavlink_found
{
  bt__mavlink_kind kind;
  size_t size; /* bytes to go on behind; 0 for BT__MAVLINK_SHORT */
  uint8_t version, sequence, system, component;
  uint32_t id;
  const bt__mavlink_message *message; /* NULL unless BT__MAVLINK_GOOD */
  double value[BT__MAVLINK_FIELDS];   /* of each field of MESSAGE; NAN for none */
  char name[BT__MAVLINK_NAME + 1];    /* of NAMED_VALUE_FLOAT, else empty */
} bt__mavlink_found;

/* Look at the N BYTES, each frame of which comes after STAMP bytes of time, 0 or BT__MAVLINK_STAMP.
   A frame not decoded here is believed only if a frame begins right behind, or if the bytes end
   there.  */
void bt__mavlink_next (const uint8_t *bytes, size_t n, size_t stamp, bt__mavlink_found *found);

#endif
