/* The options of a benchmark: one table for reading them and for --help.

   Every bench knows --quick, a short form of some seconds with the same kinds of rows, --about,
   what it was compiled by, and --help.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_BENCH_OPTIONS_H
#define BT_BENCH_OPTIONS_H

typedef struct bench_option
{
  const char *name; /* as after two dashes */
  long *value;      /* the default, and what is read */
  long least, most; /* of the number it takes; both 0: it takes none, and sets 1 */
  long quick;       /* the default with --quick; 0: the same */
  const char *help; /* what the number is */
} bench_option;

/* An option that takes a word, kept as it stands.  */
typedef struct bench_word
{
  const char *name;
  const char **value; /* the default, and what is read; NULL: none */
  const char *what;   /* in capitals, what it takes */
  const char *help;
} bench_word;

typedef struct bench_program
{
  const char *name;    /* bight-bench-NAME */
  const char *purpose; /* a sentence without its full stop */
  const bench_option *options;
  int count; /* at most 12 */
} bench_program;

enum
{
  BENCH_GO_ON = -1
};

/* Read ARGV into the options of PROGRAM.  Return BENCH_GO_ON, or the status to exit with: after
   --help and --about, or after saying on standard error what is wrong.  */
int bench_options (const bench_program *program, int argc, char **argv);

/* The same with COUNT options WORDS more, six at most.  */
int bench_options_and_words (const bench_program *program, const bench_word *words, int count,
                             int argc, char **argv);

#endif
