/* ESRI ASCII grids: a header of words and numbers in any order and case, then the heights row by
   row from the north, separated by white space however it falls.  Every error names its line.

     ncols 3            cells from west to east
     nrows 2            from south to north
     xllcorner 500      west edge of the grid, m; or xllcenter, centre of its westernmost cells
     yllcorner 200      south edge; or yllcenter
     cellsize 10        m; or dx and dy
     NODATA_value -9999 a height that says: none here; may be left out

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <locale.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "base/error.h"
#include "base/fd.h"
#include "mesh/file.h"
#include "mesh/grid.h"

enum
{
  SHOWN = 24 /* bytes of a wrong word that are quoted */
};

static const uint64_t most_bytes = 500000000;
static const double height_max = 1e5; /* m: farther than any bottom or peak */

/* m: beyond it doubles resolve no terrain.  */
#define FAR 1e9

/* One word of the text and where it stands.  */
typedef struct word
{
  const char *at;
  size_t n;
  long line;
} word;

typedef struct reader
{
  const char *name;
  const char *at, *end;
  long line;
  int is_grid;    /* the header has begun: only then is anything of the file quoted */
  locale_t plain; /* a point in numbers, whatever the user's language */
  bt_error *error;
} reader;

/* ---- Words and numbers ---- */

static int
is_space (char c)
{
  return c == ' ' || (c >= '\t' && c <= '\r');
}

/* The next word; N is 0 at the end of the text.  */
static word
next_word (reader *r)
{
  while (r->at < r->end && is_space (*r->at))
    r->line += *r->at++ == '\n';
  word w = { r->at, 0, r->line };
  while (r->at < r->end && !is_space (*r->at))
    r->at++;
  w.n = (size_t)(r->at - w.at);
  return w;
}

/* The word W for an error message.  Of a file that is no grid nothing is shown: a world may name
   any file, and the message must not leak the file's text.  */
static const char *
show_word (const reader *r, const word *w, char text[SHOWN + 4])
{
  if (!r->is_grid)
    return strcpy (text, "...");
  size_t n = w->n < SHOWN ? w->n : SHOWN;
  for (size_t i = 0; i < n; i++)
    text[i] = w->at[i] >= ' ' && w->at[i] < 127 ? w->at[i] : '?';
  strcpy (text + n, w->n > SHOWN ? "..." : "");
  return text;
}

/* Is W the lower-case NAME in any case?  */
static int
is_word (const reader *r, const word *w, const char *name)
{
  return w->n == strlen (name) && strncasecmp_l (w->at, name, w->n, r->plain) == 0;
}

/* Read W as a finite decimal number.  Words end at white space or at the final NUL of the text, so
   strtod never reads beyond.  */
static int
to_number (const reader *r, const word *w, double *value)
{
  char *end;
  if (w->n == 0 || strspn (w->at, "0123456789+-.eE") < w->n)
    return 0;
  *value = strtod_l (w->at, &end, r->plain);
  return end == w->at + w->n && isfinite (*value);
}

static bt_status
fail_number (const reader *r, const word *w, const char *wanted)
{
  char text[SHOWN + 4];
  const char *hint = memchr (w->at, ',', w->n) ? "; decimals are written with a point" : "";
  if (w->n == 0)
    return bt__fail (r->error, BT_ERR_FORMAT, "%s, line %ld: the file ends where %s was expected",
                     r->name, w->line, wanted);
  return bt__fail (r->error, BT_ERR_FORMAT, "%s, line %ld: `%s' where %s was expected%s", r->name,
                   w->line, show_word (r, w, text), wanted, hint);
}

/* ---- The header ---- */

typedef enum key
{
  NCOLS,
  NROWS,
  XCORNER,
  XCENTER,
  YCORNER,
  YCENTER,
  CELLSIZE,
  DX,
  DY,
  NODATA,
  KEYS
} key;

typedef struct header
{
  double value[KEYS];
  int given[KEYS];
} header;

/* What a key's number must be.  */
typedef struct rule
{
  const char *name, *wanted;
  double min, max;
} rule;

static const rule rules[KEYS] = {
  { "ncols", "a whole number from 2 on", 2, 1e9 },
  { "nrows", "a whole number from 2 on", 2, 1e9 },
  { "xllcorner", "a number of metres", -FAR, FAR },
  { "xllcenter", "a number of metres", -FAR, FAR },
  { "yllcorner", "a number of metres", -FAR, FAR },
  { "yllcenter", "a number of metres", -FAR, FAR },
  { "cellsize", "a positive number of metres", 1e-6, 1e9 },
  { "dx", "a positive number of metres", 1e-6, 1e9 },
  { "dy", "a positive number of metres", 1e-6, 1e9 },
  { "nodata_value", "a number", -HUGE_VAL, HUGE_VAL },
};

static int
find_key (const reader *r, const word *w)
{
  for (int k = 0; k < KEYS; k++)
    if (is_word (r, w, rules[k].name))
      return k;
  return -1;
}

static bt_status
read_value (reader *r, int k, header *h)
{
  word w = next_word (r);
  double v;
  if (k == NODATA && is_word (r, &w, "nan"))
    v = NAN;
  else if (!to_number (r, &w, &v) || v < rules[k].min || v > rules[k].max
           || (k <= NROWS && v != floor (v)))
    return fail_number (r, &w, rules[k].wanted);
  h->value[k] = v;
  h->given[k] = 1;
  return BT_OK;
}

/* Read keys with their numbers up to the first other word: the first height, left unread.  */
static bt_status
read_keys (reader *r, header *h)
{
  for (;;)
    {
      reader before = *r;
      char text[SHOWN + 4];
      double number;
      word w = next_word (r);
      int k = find_key (r, &w);
      if (w.n == 0 || to_number (r, &w, &number) || is_word (r, &w, "nan"))
        {
          *r = before;
          return BT_OK;
        }
      if (k < 0 && !r->is_grid)
        return bt__fail (r->error, BT_ERR_FORMAT,
                         "%s, line %ld: it is no ASCII grid: one begins with ncols and a number",
                         r->name, w.line);
      if (k < 0)
        return bt__fail (r->error, BT_ERR_FORMAT,
                         "%s, line %ld: `%s' where ncols, nrows, xllcorner or xllcenter, yllcorner "
                         "or yllcenter, cellsize (or dx and dy), NODATA_value or a height was "
                         "expected",
                         r->name, w.line, show_word (r, &w, text));
      r->is_grid |= k != DX && k != DY; /* words of other files too */
      if (h->given[k])
        return bt__fail (r->error, BT_ERR_FORMAT, "%s, line %ld: %s is given twice", r->name,
                         w.line, rules[k].name);
      bt_status s = read_value (r, k, h);
      if (s != BT_OK)
        return s;
    }
}

static int
has_key (const header *h, key k)
{
  return h->given[k];
}

/* The words for what H lacks, or NULL.  */
static const char *
missing_keys (const header *h)
{
  if (!has_key (h, NCOLS))
    return "ncols";
  if (!has_key (h, NROWS))
    return "nrows";
  if (has_key (h, XCORNER) == has_key (h, XCENTER))
    return "one of xllcorner and xllcenter";
  if (has_key (h, YCORNER) == has_key (h, YCENTER))
    return "one of yllcorner and yllcenter";
  if (has_key (h, CELLSIZE) ? has_key (h, DX) || has_key (h, DY)
                            : !has_key (h, DX) || !has_key (h, DY))
    return "either cellsize or dx and dy";
  return NULL;
}

static bt_status
read_header (reader *r, header *h)
{
  memset (h, 0, sizeof *h);
  h->value[NODATA] = -9999; /* what the format says of a file that does not */
  bt_status s = read_keys (r, h);
  if (s != BT_OK)
    return s;
  const char *what = missing_keys (h);
  if (what)
    return bt__fail (r->error, BT_ERR_FORMAT, "%s, line %ld: the header ends; it must give %s",
                     r->name, r->line, what);
  if (h->value[NCOLS] * h->value[NROWS] > BT_HEIGHTS_POSTS_MAX)
    return bt__fail (r->error, BT_ERR_LIMIT,
                     "%s has %.0f by %.0f heights; at most %d in all are allowed", r->name,
                     h->value[NCOLS], h->value[NROWS], BT_HEIGHTS_POSTS_MAX);
  return BT_OK;
}

/* Posts stand at the centres of cells.  */
static bt_heights
place_posts (const header *h)
{
  double dx = h->value[has_key (h, CELLSIZE) ? CELLSIZE : DX];
  double dy = h->value[has_key (h, CELLSIZE) ? CELLSIZE : DY];
  return (bt_heights){ .nx = (size_t)h->value[NCOLS],
                       .ny = (size_t)h->value[NROWS],
                       .x = has_key (h, XCENTER) ? h->value[XCENTER] : h->value[XCORNER] + dx / 2,
                       .y = has_key (h, YCENTER) ? h->value[YCENTER] : h->value[YCORNER] + dy / 2,
                       .dx = dx,
                       .dy = dy };
}

/* ---- The heights ---- */

static bt_status
read_height (reader *r, double nodata, double *z)
{
  word w = next_word (r);
  if (is_word (r, &w, "nan") && isnan (nodata))
    *z = NAN;
  else if (!to_number (r, &w, z))
    return fail_number (r, &w, "a height");
  else if (*z == nodata)
    *z = NAN;
  else if (fabs (*z) > height_max)
    return fail_number (r, &w, "a height within 100 km of the sea surface, or the NODATA_value,");
  return BT_OK;
}

static bt_status
read_heights (reader *r, const header *h, bt_heights_data *data)
{
  size_t nx = data->heights.nx, ny = data->heights.ny, known = 0;
  for (size_t row = ny; row-- > 0;)
    for (size_t i = 0; i < nx; i++)
      {
        double *z = data->z + row * nx + i;
        bt_status s = read_height (r, h->value[NODATA], z);
        if (s != BT_OK)
          return s;
        known += !isnan (*z);
      }
  word w = next_word (r);
  if (w.n > 0)
    return fail_number (r, &w, "the end of the file");
  if (known == 0)
    return bt__fail (r->error, BT_ERR_FORMAT, "%s has no height: every one is the NODATA_value",
                     r->name);
  return BT_OK;
}

static bt_status
parse_grid (reader *r, bt_heights_data *data)
{
  header h;
  bt_status s = read_header (r, &h);
  if (s != BT_OK)
    return s;
  data->heights = place_posts (&h);
  data->z = malloc (data->heights.nx * data->heights.ny * sizeof *data->z);
  if (!data->z)
    return bt__fail (r->error, BT_ERR_LIMIT, "%s: no memory for %zu by %zu heights", r->name,
                     data->heights.nx, data->heights.ny);
  data->heights.z = data->z;
  return read_heights (r, &h, data);
}

/* ---- The file ---- */

void
bt_heights_data_free (bt_heights_data *data)
{
  if (!data)
    return;
  free (data->z);
  free (data);
}

bt_status
bt__grid_parse (const char *name, const char *text, size_t n, bt_heights_data **out,
                bt_error *error)
{
  static const char mark[] = "\xef\xbb\xbf"; /* what some editors put before UTF-8 */
  bt_heights_data *data = calloc (1, sizeof *data);
  reader r = { name, text, text + n, 1, 0, newlocale (LC_ALL_MASK, "C", (locale_t)0), error };
  bt_status s;
  *out = NULL;
  if (n >= 3 && memcmp (text, mark, 3) == 0)
    r.at += 3;
  if (data && r.plain)
    s = parse_grid (&r, data);
  else
    s = bt__fail (error, BT_ERR_LIMIT, "%s: no memory", name);
  if (r.plain)
    freelocale (r.plain);
  if (s == BT_OK)
    *out = data;
  else
    bt_heights_data_free (data);
  return s;
}

bt_status
bt_heights_read (const char *file, bt_heights_data **out, bt_error *error)
{
  const char *name = bt__file_tail (file);
  int fd;
  uint64_t size;
  *out = NULL;
  bt_status s = bt__file_open (file, most_bytes, &fd, &size, error);
  if (s != BT_OK)
    return s;
  char *text = malloc (size + 1);
  if (text)
    {
      size_t n = bt__read_all (fd, text, size);
      text[n] = '\0';
      s = bt__grid_parse (name, text, n, out, error);
      free (text);
    }
  else
    s = bt__fail (error, BT_ERR_LIMIT, "%s: no memory to read it", name);
  close (fd);
  return s;
}
