/* Flat structs as tables of their members, with the values allowed for data from outside.

   The state of a dive can be read from a file, and the checksum has no key: an attacker who changes
   a count can recompute the checksum.  So every struct of the state has, beside its definition, a
   table of the values allowed for each member, and a state from outside is judged by the tables,
   byte by byte, before use.  A test asks bt__record_gap of every table, to find members without a
   row.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_BASE_RECORD_H
#define BT_BASE_RECORD_H

#include <float.h>
#include <stddef.h>
#include <stdint.h>

#include <bight/status.h>
#include <bight/vec.h>

typedef enum bt__member_kind
{
  BT__MEMBER_REAL,  /* doubles from LOW to HIGH: an infinity only if it is one of the bounds */
  BT__MEMBER_WHOLE, /* int64_t from LOW to HIGH */
  BT__MEMBER_BITS,  /* words of eight bytes: any */
  BT__MEMBER_RECORD /* structs with a table of their own */
} bt__member_kind;

/* What an index lies below: of its own table alone, or of what the world has.  */
typedef enum bt__below
{
  BT__BELOW_HIGH = 0, /* no more than HIGH of the member */
  BT__BELOW_OBJECTS,  /* obstacles and tethers */
  BT__BELOW_MOVERS,
  BT__BELOW_COUNT
} bt__below;

struct bt__record;

typedef struct bt__member
{
  const char *name;
  size_t at, size; /* bytes */
  bt__member_kind kind;
  double low, high;
  int or_nan; /* REAL: NaN means something too */
  bt__below below;
  const struct bt__record *record;
} bt__member;

typedef struct bt__record
{
  const char *name; /* what a struct is, for messages */
  size_t size;
  const bt__member *member;
  size_t members;
} bt__record;

/* The kind of a member, by its type: whatever else has a table of its own.  */
#define BT__KIND(s, m)                                                                             \
  _Generic (((s *)0)->m,                                                                           \
      double: BT__MEMBER_REAL,                                                                     \
      double *: BT__MEMBER_REAL,                                                                   \
      bt_vec3: BT__MEMBER_REAL,                                                                    \
      bt_vec3 *: BT__MEMBER_REAL,                                                                  \
      int64_t: BT__MEMBER_WHOLE)

#define BT__PLACE(s, m) #m, offsetof(s, m), sizeof(((s *)0)->m)

/* Entries of a table for the member M of the struct S: numbers from LO to HI, ...  */
#define BT__WITHIN(s, m, lo, hi)                                                                   \
  {                                                                                                \
    BT__PLACE (s, m), BT__KIND (s, m), lo, hi, 0, 0, NULL                                          \
  }
/* ... or NaN; ...  */
#define BT__OR_NAN(s, m, lo, hi)                                                                   \
  {                                                                                                \
    BT__PLACE (s, m), BT__KIND (s, m), lo, hi, 1, 0, NULL                                          \
  }
/* ... zero or one; whole numbers from LO on, below what the world has of OF; a struct, or an array
   of them, with the table R.  */
#define BT__TRUTH(s, m) BT__WITHIN (s, m, 0, 1)
#define BT__INDEX(s, m, lo, of)                                                                    \
  {                                                                                                \
    BT__PLACE (s, m), BT__KIND (s, m), lo, 0, 0, of, NULL                                          \
  }
/* ... words of which any will do: serial numbers, hashes; numbers that another check judges.  */
#define BT__ANY(s, m)                                                                              \
  {                                                                                                \
    BT__PLACE (s, m), BT__MEMBER_BITS, 0, 0, 0, 0, NULL                                            \
  }
#define BT__OF(s, m, r)                                                                            \
  {                                                                                                \
    BT__PLACE (s, m), BT__MEMBER_RECORD, 0, 0, 0, 0, &(r)                                          \
  }

#define BT__RECORD(s, what, table)                                                                 \
  {                                                                                                \
    what, sizeof (s), table, sizeof (table) / sizeof *(table)                                      \
  }

/* What no place, length or way in a dive comes near to, m; all that is finite; how far counts go,
   all of them whole doubles.  */
#define BT__FAR 1e9
#define BT__HUGE DBL_MAX
#define BT__MANY 9007199254740992.0

/* Context of a judgement: the counts of the world, the part being judged, the bytes judged so far.
 */
typedef struct bt__judge
{
  int64_t below[BT__BELOW_COUNT];
  const char *whose; /* "tether `line'" */
  size_t seen;       /* bytes */
  bt_error *error;
} bt__judge;

/* Judge the N structs at AT by their table.  BT_ERR_FORMAT says whose member is what, and what is
   allowed.  */
bt_status bt__judge_records (bt__judge *judge, const bt__record *record, const void *at, size_t n);

/* Judge N doubles, called WHAT.  */
bt_status bt__judge_reals (bt__judge *judge, const char *what, const double *x, size_t n,
                           double low, double high);

/* Judge one whole number that is no index of the table's.  */
bt_status bt__judge_count (bt__judge *judge, const char *what, int64_t n, int64_t low,
                           int64_t high);

/* BT_ERR_FORMAT unless what holds TRUE_OF all sound states HOLDS.  */
bt_status bt__judge_that (bt__judge *judge, int holds, const char *true_of);

/* Return the offset of the first byte of the struct of RECORD that is in no row, in two rows, or in
   a row that is no whole word; the size of the struct if RECORD is complete.  */
size_t bt__record_gap (const bt__record *record);

#endif
