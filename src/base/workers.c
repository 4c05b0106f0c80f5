/* Workers: see workers.h.

   A round is open from the time its tasks are laid out until the caller finds no task left.  A
   worker that wakes during an open round takes part, and the caller waits for such workers alone: a
   worker that wakes late, on a busy machine, delays nobody.  In rounds in close succession the
   workers are still awake, because each worker polls for a while, yielding the processor, before
   sleeping.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

#include "base/workers.h"

enum
{
  MANY_PROCESSORS = 1024,
  LOOKS = 200, /* before a worker sleeps: about a tenth of a millisecond when nobody else runs */
  NOW_AND_THEN = 20000000 /* ns */
};

/* A thread that waits.  */
typedef struct hand
{
  bt__workers *all;
  int number;
  pthread_t thread;
} hand;

struct bt__workers
{
  int hands, started, ever; /* that there may be; that there are; ever */
  pid_t process;            /* that started them; 0: none are */
  pthread_mutex_t lock;
  pthread_cond_t wake, rested;
  atomic_ullong round; /* the last that was opened */
  atomic_int busy;     /* workers that take part in it */
  int open, stop;
  void (*duty) (void *user, int w, int k);
  void *user;
  int tasks;
  atomic_int next;
  hand hand[];
};

static void
take_part (bt__workers *all, int w)
{
  int k;
  while ((k = atomic_fetch_add_explicit (&all->next, 1, memory_order_relaxed)) < all->tasks)
    all->duty (all->user, w, k);
}

/* Wait for a round after DONE; return its number, 0: there are no more.  Whoever returns takes part
   in it.  */
static unsigned long long
join_round (bt__workers *all, unsigned long long done)
{
  unsigned long long round;
  for (int i = 0; i < LOOKS && all->round == done; i++)
    sched_yield ();
  pthread_mutex_lock (&all->lock);
  while (!all->stop && (!all->open || all->round == done))
    pthread_cond_wait (&all->wake, &all->lock);
  round = all->stop ? 0 : all->round;
  all->busy += round > 0;
  pthread_mutex_unlock (&all->lock);
  return round;
}

static void
leave_round (bt__workers *all)
{
  pthread_mutex_lock (&all->lock);
  if (--all->busy == 0)
    pthread_cond_signal (&all->rested);
  pthread_mutex_unlock (&all->lock);
}

static void *
live (void *data)
{
  hand *self = data;
  unsigned long long done = 0;
  while ((done = join_round (self->all, done)))
    {
      take_part (self->all, self->number);
      leave_round (self->all);
    }
  return NULL;
}

/* Signals, ^C among them, are for the caller's threads.  */
static void
start_threads (bt__workers *all)
{
  sigset_t none, before;
  sigfillset (&none);
  pthread_sigmask (SIG_SETMASK, &none, &before);
  while (all->started < all->hands)
    {
      hand *h = &all->hand[all->started];
      *h = (hand){ .all = all, .number = all->started + 1 };
      if (pthread_create (&h->thread, NULL, live, h))
        break;
      all->started++;
    }
  pthread_sigmask (SIG_SETMASK, &before, NULL);
  all->ever += all->started;
}

/* A child process has the memory of its parent and none of the parent's threads: locks possibly
   held by a thread are made anew, and waiting threads are forgotten.  */
static void
begin_in (bt__workers *all, pid_t process)
{
  all->process = process;
  all->started = all->open = 0;
  all->busy = 0;
  pthread_mutex_init (&all->lock, NULL);
  pthread_cond_init (&all->wake, NULL);
  pthread_cond_init (&all->rested, NULL);
  start_threads (all);
}

bt__workers *
bt__workers_new (int count)
{
  size_t hands = (size_t)count - 1;
  bt__workers *all = calloc (1, sizeof *all + hands * sizeof (hand));
  if (all)
    all->hands = (int)hands;
  return all;
}

void
bt__workers_free (bt__workers *all)
{
  if (all && all->process == getpid ())
    {
      pthread_mutex_lock (&all->lock);
      all->stop = 1;
      pthread_cond_broadcast (&all->wake);
      pthread_mutex_unlock (&all->lock);
      for (int i = 0; i < all->started; i++)
        pthread_join (all->hand[i].thread, NULL);
      pthread_cond_destroy (&all->wake);
      pthread_cond_destroy (&all->rested);
      pthread_mutex_destroy (&all->lock);
    }
  free (all);
}

static void
open_round (bt__workers *all, int tasks, void (*duty) (void *user, int w, int k), void *user)
{
  pthread_mutex_lock (&all->lock);
  all->duty = duty;
  all->user = user;
  all->tasks = tasks;
  atomic_store_explicit (&all->next, 0, memory_order_relaxed);
  all->round++;
  all->open = 1;
  pthread_mutex_unlock (&all->lock);
  pthread_cond_broadcast (&all->wake);
}

static struct timespec
soon (void)
{
  struct timespec t;
  timespec_get (&t, TIME_UTC);
  t.tv_nsec += NOW_AND_THEN;
  t.tv_sec += t.tv_nsec / 1000000000;
  t.tv_nsec %= 1000000000;
  return t;
}

/* Wait, with the lock held, until the others may have come to rest.  */
static void
wait_a_while (bt__workers *all, void (*meanwhile) (void *user))
{
  struct timespec then = soon ();
  if (!meanwhile)
    pthread_cond_wait (&all->rested, &all->lock);
  else if (pthread_cond_timedwait (&all->rested, &all->lock, &then) != 0)
    {
      pthread_mutex_unlock (&all->lock);
      meanwhile (all->user);
      pthread_mutex_lock (&all->lock);
    }
}

static void
close_round (bt__workers *all, void (*meanwhile) (void *user))
{
  pthread_mutex_lock (&all->lock);
  all->open = 0;
  pthread_mutex_unlock (&all->lock);
  for (int i = 0; i < LOOKS && all->busy > 0; i++)
    sched_yield ();
  pthread_mutex_lock (&all->lock);
  while (all->busy > 0)
    wait_a_while (all, meanwhile);
  pthread_mutex_unlock (&all->lock);
}

void
bt__workers_run (bt__workers *all, int tasks, void (*duty) (void *user, int w, int k),
                 void (*meanwhile) (void *user), void *user)
{
  pid_t process = getpid ();
  for (int k = 0; !all && k < tasks; k++)
    duty (user, 0, k);
  if (!all)
    return;
  if (all->process != process)
    begin_in (all, process);
  open_round (all, tasks, duty, user);
  take_part (all, 0);
  close_round (all, meanwhile);
}

int
bt__processors (void)
{
  long n = 0;
#ifdef CPU_COUNT
  cpu_set_t set;
  if (sched_getaffinity (0, sizeof set, &set) == 0)
    n = CPU_COUNT (&set);
#endif
  if (n < 1)
    n = sysconf (_SC_NPROCESSORS_ONLN);
  return n < 1 ? 1 : n > MANY_PROCESSORS ? MANY_PROCESSORS : (int)n;
}

int
bt__workers_started (const bt__workers *all)
{
  return all->ever;
}
