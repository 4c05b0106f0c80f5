/* Tietze moves on a presentation of a group: a letter that occurs once in a relation is expressed
   by the other letters of the relation and eliminated (H. Tietze 1908; see tietze.h).

   A log keeps, in order, what each letter was replaced by; read backwards, the log gives every
   letter as a word in the remaining generators.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "aware/tietze.h"
#include "base/error.h"

enum
{
  NIELSEN_ROUNDS = 200,
  NIELSEN_LETTERS = 40, /* more letters left than this are not tried in pairs */
  LENGTH_MAX = 1 << 14, /* letters: a word this long is none that anybody asks for */
  WORK_MAX = 300000000  /* letters looked at: a group that takes more is not simplified */
};

/* ---- Words that grow ---- */

static void
push (bt__group *g, bt__letters *w, int32_t letter)
{
  if (w->n > 0 && w->at[w->n - 1] == -letter)
    {
      w->n--;
      return;
    }
  if (w->n == w->room)
    {
      uint32_t room = w->room ? 2 * w->room : 8;
      int32_t *at = room <= LENGTH_MAX ? realloc (w->at, room * sizeof *at) : NULL;
      if (!at)
        {
          g->failed = 1;
          return;
        }
      w->at = at;
      w->room = room;
    }
  w->at[w->n++] = letter;
}

static void
append_letters (bt__group *g, bt__letters *w, const bt__letters *more, int inverse)
{
  for (uint32_t i = 0; i < more->n; i++)
    push (g, w, inverse ? -more->at[more->n - 1 - i] : more->at[i]);
}

/* The same word about another point: without letters that cancel round the end.  */
static void
reduce_cyclic (bt__letters *w)
{
  uint32_t cut = 0;
  while (w->n > 2 * cut + 1 && w->at[cut] == -w->at[w->n - 1 - cut])
    cut++;
  if (cut > 0)
    {
      w->n -= 2 * cut;
      memmove (w->at, w->at + cut, w->n * sizeof *w->at);
    }
}

static uint32_t
occurrences (const bt__letters *w, int32_t letter)
{
  uint32_t n = 0;
  for (uint32_t i = 0; i < w->n; i++)
    n += w->at[i] == letter || w->at[i] == -letter;
  return n;
}

/* Put WORD for LETTER in *W; *SPARE is used.  */
static void
put_word (bt__group *g, bt__letters *w, int32_t letter, const bt__letters *word, bt__letters *spare)
{
  if (occurrences (w, letter) == 0)
    return;
  spare->n = 0;
  for (uint32_t i = 0; i < w->n; i++)
    if (w->at[i] == letter || w->at[i] == -letter)
      append_letters (g, spare, word, w->at[i] < 0);
    else
      push (g, spare, w->at[i]);
  bt__letters swap = *w;
  *w = *spare;
  *spare = swap;
}

/* ---- The log ---- */

typedef struct entry
{
  int32_t letter;
  bt__letters word;
} entry;

typedef struct job
{
  bt__group *g;
  entry *log;
  uint32_t logged, room;
  uint8_t *gone;   /* letter k - 1 was eliminated */
  uint32_t *total; /* occurrences of letter k - 1 in all relations */
  uint32_t *here;  /* in one relation; zeros between uses */
  uint64_t work;   /* letters looked at */
  bt__letters spare;
} job;

static entry *
log_one (job *k, int32_t letter)
{
  if (k->logged == k->room)
    {
      uint32_t room = k->room ? 2 * k->room : 64;
      entry *log = realloc (k->log, room * sizeof *log);
      if (!log)
        {
          k->g->failed = 1;
          return NULL;
        }
      k->log = log;
      k->room = room;
    }
  entry *e = k->log + k->logged++;
  *e = (entry){ letter, { NULL, 0, 0 } };
  return e;
}

/* Put the entry's word for its letter in all relations.  */
static void
substitute_letter (job *k, const entry *e)
{
  for (uint32_t r = 0; r < k->g->relations && (r % 256 || !bt__ask (k->g->asker)); r++)
    {
      k->work += k->g->relation[r].n;
      put_word (k->g, k->g->relation + r, e->letter, &e->word, &k->spare);
      reduce_cyclic (k->g->relation + r);
    }
}

static void
drop_empty (bt__group *g)
{
  uint32_t n = 0;
  for (uint32_t r = 0; r < g->relations; r++)
    {
      bt__letters w = g->relation[r];
      if (w.n == 0)
        free (w.at);
      else
        g->relation[n++] = w;
    }
  g->relations = n;
}

/* ---- Elimination ---- */

static uint32_t
letter_index (int32_t letter)
{
  return (uint32_t)abs (letter) - 1;
}

static void
count_all (job *k)
{
  memset (k->total, 0, k->g->letters * sizeof *k->total);
  for (uint32_t r = 0; r < k->g->relations; r++)
    {
      k->work += k->g->relation[r].n;
      for (uint32_t i = 0; i < k->g->relation[r].n; i++)
        k->total[letter_index (k->g->relation[r].at[i])]++;
    }
  k->g->failed |= k->work > WORK_MAX;
}

/* Find the cheapest relation *R and place *AT of a letter that occurs once in it.  */
static int
find_single (job *k, uint32_t *r, uint32_t *at)
{
  double best = INFINITY;
  count_all (k);
  for (uint32_t j = 0; j < k->g->relations; j++)
    {
      const bt__letters *w = k->g->relation + j;
      for (uint32_t i = 0; i < w->n; i++)
        k->here[letter_index (w->at[i])]++;
      for (uint32_t i = 0; i < w->n; i++)
        {
          uint32_t x = letter_index (w->at[i]);
          double cost = ((double)w->n - 2) * ((double)k->total[x] - 1);
          if (k->here[x] == 1 && cost < best)
            {
              best = cost;
              *r = j;
              *at = i;
            }
        }
      for (uint32_t i = 0; i < w->n; i++)
        k->here[letter_index (w->at[i])] = 0;
    }
  return best < INFINITY;
}

/* The relation is u x v = 1: x is (v u)^-1.  */
static void
eliminate_letter (job *k, uint32_t r, uint32_t at)
{
  bt__letters *w = k->g->relation + r;
  int32_t letter = w->at[at];
  entry *e = log_one (k, abs (letter));
  if (!e)
    return;
  for (uint32_t i = 1; i < w->n; i++)
    {
      /* x = v^-1 ... read backwards from x; x^-1 = v u.  */
      int32_t other = letter > 0 ? -w->at[(at + w->n - i) % w->n] : w->at[(at + i) % w->n];
      push (k->g, &e->word, other);
    }
  w->n = 0;
  k->gone[letter_index (letter)] = 1;
  substitute_letter (k, e);
  drop_empty (k->g);
}

/* ---- Nielsen moves ---- */

static uint64_t
total_length (const bt__group *g)
{
  uint64_t n = 0;
  for (uint32_t r = 0; r < g->relations; r++)
    n += g->relation[r].n;
  return n;
}

/* The length after A is put as A B^-1 (KIND 0), B^-1 A (1) or B A B^-1 (2), B of either sign.  */
static void
nielsen_word (bt__group *g, int32_t a, int32_t b, int kind, bt__letters *out)
{
  out->n = 0;
  if (kind == 2)
    push (g, out, b);
  if (kind == 1)
    push (g, out, -b);
  push (g, out, a);
  if (kind != 1)
    push (g, out, -b);
}

static uint64_t
length_with (job *k, int32_t a, const bt__letters *word, bt__letters *copy)
{
  uint64_t n = 0;
  for (uint32_t r = 0; r < k->g->relations; r++)
    {
      copy->n = 0;
      append_letters (k->g, copy, k->g->relation + r, 0);
      put_word (k->g, copy, a, word, &k->spare);
      reduce_cyclic (copy);
      n += copy->n;
    }
  return n;
}

/* Make the first move that shortens; return true if there was one.  */
static int
nielsen (job *k)
{
  int32_t letter[NIELSEN_LETTERS];
  uint32_t n = 0;
  uint64_t now = total_length (k->g);
  bt__letters word = { NULL, 0, 0 }, copy = { NULL, 0, 0 };
  int found = 0;
  count_all (k);
  for (uint32_t x = 0; x < k->g->letters && n < NIELSEN_LETTERS; x++)
    if (k->total[x] > 0)
      letter[n++] = (int32_t)x + 1;
  for (uint32_t i = 0; i < n && n < NIELSEN_LETTERS && !found; i++)
    for (uint32_t j = 0; j < 6 * n && !found && !bt__ask (k->g->asker); j++)
      {
        int32_t a = letter[i], b = letter[j / 6] * (j % 2 ? 1 : -1);
        if (abs (b) == a)
          continue;
        nielsen_word (k->g, a, b, (int)(j % 6 / 2), &word);
        if (length_with (k, a, &word, &copy) >= now)
          continue;
        entry *e = log_one (k, a);
        found = e != NULL;
        if (e)
          {
            append_letters (k->g, &e->word, &word, 0);
            substitute_letter (k, e);
            drop_empty (k->g);
          }
      }
  free (word.at);
  free (copy.at);
  return found;
}

/* ---- What the letters are ---- */

/* Read the log backwards: at each entry IS holds what letters were to be from there on.  */
static void
resolve_log (job *k)
{
  bt__group *g = k->g;
  for (uint32_t x = 0; x < g->letters; x++)
    if (!k->gone[x])
      {
        g->origin[g->rank++] = (int32_t)x + 1;
        push (g, g->is + x, (int32_t)g->rank);
      }
  for (uint32_t i = k->logged; i > 0 && !bt__ask (g->asker); i--)
    {
      const entry *e = k->log + i - 1;
      bt__letters now = { NULL, 0, 0 };
      for (uint32_t j = 0; j < e->word.n; j++)
        append_letters (g, &now, g->is + letter_index (e->word.at[j]), e->word.at[j] < 0);
      free (g->is[e->letter - 1].at);
      g->is[e->letter - 1] = now;
    }
  for (uint32_t x = 0; x < g->letters; x++)
    g->longest = g->is[x].n > g->longest ? g->is[x].n : g->longest;
}

/* ---- All of it ---- */

void
bt__group_begin (bt__group *g, uint32_t letters)
{
  memset (g, 0, sizeof *g);
  g->letters = letters;
  g->is = calloc (letters + 1, sizeof *g->is);
  g->origin = calloc (letters + 1, sizeof *g->origin);
  g->failed = !g->is || !g->origin;
}

void
bt__group_relate (bt__group *g, const int32_t *letters, uint32_t n)
{
  if (g->relations == g->room)
    {
      uint32_t room = g->room ? 2 * g->room : 64;
      bt__letters *relation = realloc (g->relation, room * sizeof *relation);
      if (!relation)
        {
          g->failed = 1;
          return;
        }
      g->relation = relation;
      g->room = room;
    }
  bt__letters *w = g->relation + g->relations++;
  *w = (bt__letters){ NULL, 0, 0 };
  for (uint32_t i = 0; i < n; i++)
    push (g, w, letters[i]);
  reduce_cyclic (w);
}

static void
simplify_group (job *k)
{
  uint32_t r, at;
  drop_empty (k->g);
  for (int round = 0; k->g->relations > 0 && round < NIELSEN_ROUNDS && !k->g->failed; round++)
    {
      while (!k->g->failed && !bt__ask (k->g->asker) && find_single (k, &r, &at))
        eliminate_letter (k, r, at);
      if (k->g->relations == 0 || bt__ask (k->g->asker) || !nielsen (k))
        break;
    }
}

bt_status
bt__group_simplify (bt__group *g, bt_error *error)
{
  job k = { .g = g };
  k.gone = calloc (g->letters + 1, 1);
  k.total = calloc (g->letters + 1, sizeof *k.total);
  k.here = calloc (g->letters + 1, sizeof *k.here);
  if (!k.gone || !k.total || !k.here)
    g->failed = 1;
  if (!g->failed)
    {
      simplify_group (&k);
      g->leftover = g->relations;
      resolve_log (&k);
    }
  for (uint32_t i = 0; i < k.logged; i++)
    free (k.log[i].word.at);
  free (k.log);
  free (k.gone);
  free (k.total);
  free (k.here);
  free (k.spare.at);
  bt_status left = bt__stopped (g->asker, error);
  if (left != BT_OK || !g->failed)
    return left;
  return bt__fail (error, BT_ERR_LIMIT,
                   "the %u letters of this world have words too long, or too many, to tell "
                   "classes by",
                   (unsigned)g->letters);
}

void
bt__group_free (bt__group *g)
{
  for (uint32_t r = 0; g->relation && r < g->relations; r++)
    free (g->relation[r].at);
  for (uint32_t x = 0; g->is && x < g->letters; x++)
    free (g->is[x].at);
  free (g->relation);
  free (g->is);
  free (g->origin);
  memset (g, 0, sizeof *g);
}
