/* The clock of the benchmarks and the kernel every time is measured against.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_TESTBED_CALIBRATION_H
#define BT_TESTBED_CALIBRATION_H

/* Return the CPU time of this process in seconds.  */
double bench_now (void);

/* Sort the N numbers X in place and return their median.  */
double bench_median (double *x, int n);

/* Return the CPU seconds of one calibration step: the explicit base line of the dynamic models, one
   fourth-order Runge-Kutta step of a chain of 100 intervals in a current with axial stiffness and
   damping, weight, drag on both parts of the flow and added mass.  The median of batches over about
   SECONDS. Return NaN if the chain did not stay finite.  */
double bench_calibrate (double seconds);

#endif
