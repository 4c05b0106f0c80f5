/* Is a mesh file complete?

   A library that makes up missing data must not be asked about a truncated file.  The header of a
   PLY is parsed (format, elements, properties, lists), and its elements are stepped over to the
   end: by words in an ASCII file, by sizes in a binary file of either byte order.  The first
   element not there is named in the error.  An ASCII STL must end with a line `endsolid'; a binary
   STL may also begin with `solid', so a text is an STL in ASCII only if facets follow.

   Comments are cut out of the header of a PLY because of an error in the library (whole.h).

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/error.h"
#include "mesh-reader/whole.h"

enum
{
  LINE = 256,
  ELEMENTS = 32,
  PROPERTIES = 256
};

/* What is still to be read.  */
typedef struct text
{
  const char *at, *end;
} text;

static int
is_blank (char c)
{
  return c == ' ' || (c >= '\t' && c <= '\r') || c == '\0';
}

/* ---- The header of a PLY ---- */

/* A number, or a list: how many numbers in COUNT_SIZE bytes, then the numbers.  */
typedef struct property
{
  int size, count_size; /* bytes; COUNT_SIZE 0: no list */
} property;

typedef struct element
{
  uint64_t count;
  int first, properties; /* among the header's properties */
} element;

typedef struct ply
{
  enum
  {
    PLY_ASCII,
    PLY_LITTLE,
    PLY_BIG
  } format;
  element element[ELEMENTS];
  property property[PROPERTIES];
  int elements, properties;
} ply;

/* Take the next line, without its end, cut to fit LINE.  True unless the text is over.  */
static int
next_line (text *t, char line[LINE])
{
  if (t->at == t->end)
    return 0;
  const char *end = memchr (t->at, '\n', (size_t)(t->end - t->at));
  size_t n = (size_t)((end ? end : t->end) - t->at);
  size_t kept = n < LINE - 1 ? n : LINE - 1;
  memcpy (line, t->at, kept);
  line[kept] = '\0';
  line[strcspn (line, "\r")] = '\0';
  t->at += n + (end != NULL);
  return 1;
}

static int
size_of_type (const char *type)
{
  static const struct
  {
    const char *name;
    int size;
  } types[] = { { "char", 1 },  { "uchar", 1 },  { "int8", 1 },    { "uint8", 1 },
                { "short", 2 }, { "ushort", 2 }, { "int16", 2 },   { "uint16", 2 },
                { "int", 4 },   { "uint", 4 },   { "int32", 4 },   { "uint32", 4 },
                { "float", 4 }, { "double", 8 }, { "float32", 4 }, { "float64", 8 } };
  for (size_t i = 0; type && i < sizeof types / sizeof *types; i++)
    if (strcmp (type, types[i].name) == 0)
      return types[i].size;
  return 0;
}

static int
add_element (ply *p, const char *count)
{
  char *end;
  if (p->elements == ELEMENTS || !count || *count < '0' || *count > '9')
    return 0;
  p->element[p->elements++] = (element){ strtoull (count, &end, 10), p->properties, 0 };
  return *end == '\0';
}

static int
add_property (ply *p, char **rest)
{
  const char *type = strtok_r (NULL, " \t", rest);
  property made = { 0, 0 };
  if (p->elements == 0 || p->properties == PROPERTIES || !type)
    return 0;
  int list = strcmp (type, "list") == 0;
  if (list)
    {
      made.count_size = size_of_type (strtok_r (NULL, " \t", rest));
      type = strtok_r (NULL, " \t", rest);
    }
  made.size = size_of_type (type);
  p->property[p->properties++] = made;
  p->element[p->elements - 1].properties++;
  return made.size > 0 && (!list || (made.count_size > 0 && made.count_size <= 4));
}

static int
set_format (ply *p, const char *word)
{
  static const char *const words[] = { "ascii", "binary_little_endian", "binary_big_endian" };
  for (int i = 0; word && i < 3; i++)
    if (strcmp (word, words[i]) == 0)
      {
        p->format = i;
        return 1;
      }
  return 0;
}

/* One line of the header.  True when it is understood.  */
static int
take_header_line (ply *p, char *line, int *over)
{
  char *rest, *word = strtok_r (line, " \t", &rest);
  if (!word || strcmp (word, "comment") == 0 || strcmp (word, "obj_info") == 0)
    return 1;
  if (strcmp (word, "format") == 0)
    return set_format (p, strtok_r (NULL, " \t", &rest));
  if (strcmp (word, "element") == 0)
    return strtok_r (NULL, " \t", &rest) && add_element (p, strtok_r (NULL, " \t", &rest));
  if (strcmp (word, "property") == 0)
    return add_property (p, &rest);
  *over = strcmp (word, "end_header") == 0;
  return *over;
}

/* ---- Its elements ---- */

static uint64_t
take_count (const ply *p, const char *at, int size)
{
  uint64_t n = 0;
  for (int i = 0; i < size; i++)
    n = n << 8 | (unsigned char)at[p->format == PLY_BIG ? i : size - 1 - i];
  return n;
}

/* Step over one element E of a binary file.  True when it is there.  */
static int
step_binary (const ply *p, const element *e, text *t)
{
  for (int i = e->first; i < e->first + e->properties; i++)
    {
      const property *of = p->property + i;
      uint64_t n = 1, left = (uint64_t)(t->end - t->at);
      if ((uint64_t)of->count_size > left)
        return 0;
      if (of->count_size)
        n = take_count (p, t->at, of->count_size);
      if ((uint64_t)of->count_size + n * (uint64_t)of->size > left)
        return 0;
      t->at += (uint64_t)of->count_size + n * (uint64_t)of->size;
    }
  return 1;
}

/* Step over one word; its value as a count, if it is one.  True when it is there.  */
static int
step_word (text *t, uint64_t *count)
{
  *count = 0;
  while (t->at < t->end && is_blank (*t->at))
    t->at++;
  if (t->at == t->end)
    return 0;
  for (; t->at < t->end && !is_blank (*t->at); t->at++)
    if (*count < UINT32_MAX)
      *count = 10 * *count + (uint64_t)(*t->at - '0') % 10;
  return 1;
}

/* Step over one element E of an ASCII file.  True when it is there.  */
static int
step_ascii (const ply *p, const element *e, text *t)
{
  uint64_t n, number;
  for (int i = e->first; i < e->first + e->properties; i++)
    {
      if (!step_word (t, &n))
        return 0;
      for (n = p->property[i].count_size ? n : 0; n > 0; n--)
        if (!step_word (t, &number))
          return 0;
    }
  return 1;
}

static bt_status
check_elements (const ply *p, text *t, bt_error *error)
{
  for (int k = 0; k < p->elements; k++)
    for (uint64_t i = 0; p->element[k].properties && i < p->element[k].count; i++)
      if (!(p->format == PLY_ASCII ? step_ascii : step_binary) (p, p->element + k, t))
        return bt__fail (error, BT_ERR_FORMAT,
                         "it is cut short: element %llu of the %llu of kind %d is not there",
                         (unsigned long long)i + 1, (unsigned long long)p->element[k].count, k + 1);
  return BT_OK;
}

static bt_status
check_ply (text *t, bt_error *error)
{
  ply p = { 0 };
  char line[LINE];
  int over = 0;
  if (next_line (t, line) && strcasecmp (line, "ply") != 0)
    return bt__fail (error, BT_ERR_FORMAT, "line 1 of a PLY file is `ply' alone");
  for (long n = 2; !over; n++)
    if (!next_line (t, line))
      return bt__fail (error, BT_ERR_FORMAT, "it is cut short: its header has no end_header");
    else if (!take_header_line (&p, line, &over))
      return bt__fail (error, BT_ERR_FORMAT, "line %ld is no line of a PLY header", n);
  return check_elements (&p, t, error);
}

/* ---- STL ---- */

static int
begins (const char *at, const char *end, const char *word)
{
  size_t n = strlen (word);
  return (size_t)(end - at) >= n && strncasecmp (at, word, n) == 0;
}

/* A text that has facets; a binary STL may well begin with `solid' too.  */
static int
is_text_stl (const text *t)
{
  if (!begins (t->at, t->end, "solid"))
    return 0;
  const char *second = memchr (t->at, '\n', (size_t)(t->end - t->at));
  for (; second && second < t->end && is_blank (*second); second++)
    ;
  return second && begins (second, t->end, "facet");
}

static bt_status
check_stl (const text *t, bt_error *error)
{
  const char *end = t->end;
  while (end > t->at && is_blank (end[-1]))
    end--;
  const char *line = end;
  while (line > t->at && line[-1] != '\n')
    line--;
  while (line < end && is_blank (*line))
    line++;
  if (!begins (line, end, "endsolid"))
    return bt__fail (error, BT_ERR_FORMAT, "it is cut short: an STL text ends with `endsolid'");
  return BT_OK;
}

bt_status
bt__whole (const char *bytes, size_t n, bt_error *error)
{
  text t = { bytes, bytes + n };
  if (is_text_stl (&t))
    return check_stl (&t, error);
  if (bt__is_ply (bytes, n))
    return check_ply (&t, error);
  return BT_OK;
}

int
bt__is_ply (const char *bytes, size_t n)
{
  return begins (bytes, bytes + n, "ply"); /* all that assimp asks for */
}

size_t
bt__ply_without_comments (char *bytes, size_t n)
{
  char *end = bytes + n, *line = bytes, *to = bytes;
  while (line < end && !begins (line, end, "end_header"))
    {
      char *stop = memchr (line, '\n', (size_t)(end - line)), *next = stop ? stop + 1 : end;
      size_t size = (size_t)(next - line);
      if (!begins (line, next, "comment"))
        to = (char *)memmove (to, line, size) + size;
      line = next;
    }
  size_t kept = (size_t)(to - bytes);
  memmove (line - kept, bytes, kept);
  return (size_t)(line - bytes) - kept;
}
