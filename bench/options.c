/* See options.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>

#include "options.h"

enum
{
  OPTIONS_MAX = 12,
  WORDS_MAX = 6,
  FIRST = 256,       /* getopt's values of a program's own options */
  FIRST_WORD = 1024, /* and of those that take words */
  QUICK = 'q',
  HELP = 'h',
  ABOUT = 'a'
};

static int
is_flag (const bench_option *o)
{
  return o->least == 0 && o->most == 0;
}

static void
print_help (const bench_program *p, const bench_word *words, int count)
{
  printf ("Usage: bight-bench-%s [OPTION]...\n%s.  Rows of CSV on standard output.\n\n", p->name,
          p->purpose);
  for (int i = 0; i < p->count; i++)
    {
      const bench_option *o = p->options + i;
      printf ("  --%s%s\t%s", o->name, is_flag (o) ? "" : " N", o->help);
      if (!is_flag (o))
        printf ("; %ld", *o->value);
      if (!is_flag (o) && o->quick)
        printf (", %ld with --quick", o->quick);
      putchar ('\n');
    }
  for (int i = 0; i < count; i++)
    printf ("  --%s %s\t%s\n", words[i].name, words[i].what, words[i].help);
  puts ("  --quick\tthe short form\n  --about\tits compiler and flags\n  --help\tthis text");
}

/* What it was compiled by, and how: two lines.  */
static void
print_about (void)
{
#ifdef __clang__
  puts ("clang " __clang_version__);
#else
  puts ("gcc " __VERSION__);
#endif
  puts (BENCH_FLAGS);
}

/* Read TEXT as the number of O.  Return nonzero if it is one.  */
static int
read_number (const bench_program *p, const bench_option *o, const char *text)
{
  char *end;
  long n = strtol (text, &end, 10);
  if (end == text || *end || n < o->least || n > o->most)
    {
      fprintf (stderr, "bight-bench-%s: --%s takes %ld to %ld, not %s\n", p->name, o->name,
               o->least, o->most, text);
      return 0;
    }
  *o->value = n;
  return 1;
}

/* The options GIVEN none of which was on the command line take their short form.  */
static void
shorten (const bench_program *p, const int *given)
{
  for (int i = 0; i < p->count; i++)
    if (p->options[i].quick && !given[i])
      *p->options[i].value = p->options[i].quick;
}

int
bench_options (const bench_program *p, int argc, char **argv)
{
  return bench_options_and_words (p, NULL, 0, argc, argv);
}

int
bench_options_and_words (const bench_program *p, const bench_word *words, int count, int argc,
                         char **argv)
{
  struct option known[OPTIONS_MAX + WORDS_MAX + 4] = { 0 };
  int given[OPTIONS_MAX] = { 0 }, quick = 0, c;
  for (int i = 0; i < p->count; i++)
    known[i] = (struct option){ p->options[i].name, !is_flag (p->options + i), NULL, FIRST + i };
  struct option *more = known + p->count;
  for (int i = 0; i < count; i++)
    *more++ = (struct option){ words[i].name, required_argument, NULL, FIRST_WORD + i };
  *more++ = (struct option){ "quick", no_argument, NULL, QUICK };
  *more++ = (struct option){ "help", no_argument, NULL, HELP };
  *more = (struct option){ "about", no_argument, NULL, ABOUT };
  while ((c = getopt_long (argc, argv, "", known, NULL)) != -1)
    if (c == HELP)
      return print_help (p, words, count), EXIT_SUCCESS;
    else if (c == ABOUT)
      return print_about (), EXIT_SUCCESS;
    else if (c == QUICK)
      quick = 1;
    else if (c < FIRST) /* getopt has said what is wrong */
      return EXIT_FAILURE;
    else if (c >= FIRST_WORD)
      *words[c - FIRST_WORD].value = optarg;
    else if (is_flag (p->options + c - FIRST))
      *p->options[c - FIRST].value = given[c - FIRST] = 1;
    else if (read_number (p, p->options + c - FIRST, optarg))
      given[c - FIRST] = 1;
    else
      return EXIT_FAILURE;
  if (optind < argc)
    {
      fprintf (stderr, "bight-bench-%s: %s is no option; try --help\n", p->name, argv[optind]);
      return EXIT_FAILURE;
    }
  if (quick)
    shorten (p, given);
  return BENCH_GO_ON;
}
