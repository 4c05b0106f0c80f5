/* Thrusters: the force of a command, and the command for a force.

   The T200 is the maker's measurement (Blue Robotics, "T200 thruster: performance charts", static
   thrust by pulse width at 10 to 20 V), every eighth microsecond, linear between pulse widths and
   voltages; the table contains the dead band.  A command of -1 to 1 is a pulse width of 1100 to
   1900 microseconds.  The inverse is found by bisection on the rows of one voltage, from zero
   outward.  Any other thruster has a square law, as thrust goes with the square of the revolutions.

   The autopilot computes commands at the nominal voltage of the type; at another voltage of the
   battery the same command gives another force, as on a real vehicle.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "math/vec.h"
#include "vehicle/type.h"

enum
{
  PULSES = 101, /* 1100 to 1900 microseconds */
  VOLTAGES = 6
};

#define VOLTS_LEAST 10.0
#define VOLTS_STEP 2.0

/* N, a row for each pulse width, a column for each voltage.  */
static const double t200[PULSES][VOLTAGES] = {
  { -22.649, -28.476, -34.489, -39.908, -45.016, -49.383 },
  { -22.508, -28.38, -34.251, -39.456, -44.438, -48.263 },
  { -21.796, -27.312, -33.362, -38.255, -43.326, -47.018 },
  { -21.218, -26.689, -32.294, -37.498, -42.614, -45.895 },
  { -20.684, -25.488, -31.271, -36.787, -41.013, -43.77 },
  { -20.017, -25.132, -30.381, -35.853, -39.589, -42.658 },
  { -19.172, -23.931, -29.447, -34.518, -38.388, -40.79 },
  { -18.549, -23.398, -28.291, -33.317, -37.365, -39.411 },
  { -17.748, -22.597, -27.268, -31.894, -36.12, -38.121 },
  { -17.215, -21.841, -26.378, -30.47, -34.741, -36.386 },
  { -16.503, -20.996, -25.444, -29.358, -32.917, -34.874 },
  { -15.88, -20.284, -24.421, -28.068, -31.315, -32.917 },
  { -15.257, -19.439, -23.62, -27.179, -29.714, -31.004 },
  { -14.724, -18.46, -22.908, -26.067, -28.246, -29.447 },
  { -14.145, -17.704, -21.618, -24.999, -27.223, -28.157 },
  { -13.345, -16.992, -20.773, -24.065, -26.067, -26.823 },
  { -12.944, -16.192, -19.884, -23.086, -24.777, -25.533 },
  { -12.322, -15.302, -18.727, -21.93, -23.753, -24.51 },
  { -11.654, -14.635, -17.837, -20.773, -22.73, -23.576 },
  { -11.165, -14.101, -16.859, -19.839, -21.663, -22.197 },
  { -10.542, -13.434, -16.014, -19.038, -20.684, -20.996 },
  { -9.964, -12.677, -15.346, -17.793, -19.572, -20.017 },
  { -9.519, -11.966, -14.501, -16.681, -18.46, -18.771 },
  { -8.896, -11.298, -13.745, -15.791, -17.259, -17.615 },
  { -8.363, -10.631, -12.989, -14.857, -16.28, -16.414 },
  { -7.829, -10.008, -12.144, -14.101, -15.346, -15.524 },
  { -7.384, -9.43, -11.432, -13.211, -14.368, -14.457 },
  { -6.85, -8.852, -10.676, -12.322, -13.523, -13.478 },
  { -6.405, -8.185, -9.964, -11.387, -12.499, -12.455 },
  { -6.005, -7.562, -9.341, -10.809, -11.521, -11.476 },
  { -5.427, -7.073, -8.674, -10.008, -10.631, -10.453 },
  { -5.026, -6.45, -7.918, -9.252, -9.92, -9.697 },
  { -4.582, -5.916, -7.251, -8.541, -9.163, -8.896 },
  { -4.137, -5.338, -6.672, -7.695, -8.407, -8.14 },
  { -3.737, -4.849, -6.094, -7.028, -7.562, -7.384 },
  { -3.292, -4.315, -5.382, -6.361, -6.85, -6.761 },
  { -2.891, -3.825, -4.804, -5.694, -6.228, -6.183 },
  { -2.447, -3.336, -4.181, -5.026, -5.471, -5.471 },
  { -2.091, -2.891, -3.648, -4.359, -4.849, -4.938 },
  { -1.779, -2.402, -3.114, -3.781, -4.226, -4.359 },
  { -1.512, -2.002, -2.535, -3.158, -3.603, -3.781 },
  { -1.157, -1.601, -2.046, -2.535, -2.98, -3.158 },
  { -0.845, -1.201, -1.601, -2.046, -2.358, -2.58 },
  { -0.623, -0.89, -1.201, -1.468, -1.779, -2.002 },
  { -0.445, -0.578, -0.801, -1.023, -1.246, -1.423 },
  { 0, -0.356, -0.445, -0.667, -0.756, -0.89 },
  { 0, 0, 0, -0.356, -0.445, -0.534 },
  { 0, 0, 0, 0, 0, 0 },
  { 0, 0, 0, 0, 0, 0 },
  { 0, 0, 0, 0, 0, 0 },
  { 0, 0, 0, 0, 0, 0 },
  { 0, 0, 0, 0, 0, 0 },
  { 0, 0, 0, 0, 0, 0 },
  { 0, 0, 0, 0, 0, 0 },
  { 0, 0, 0, 0.4, 0.445, 0.578 },
  { 0, 0.4, 0.623, 0.756, 0.89, 1.112 },
  { 0.534, 0.712, 0.979, 1.246, 1.468, 1.779 },
  { 0.756, 1.112, 1.423, 1.779, 2.091, 2.447 },
  { 1.068, 1.512, 1.957, 2.447, 2.802, 3.158 },
  { 1.423, 1.957, 2.58, 3.158, 3.514, 3.825 },
  { 1.779, 2.491, 3.203, 3.914, 4.181, 4.582 },
  { 2.18, 3.025, 3.87, 4.626, 4.982, 5.249 },
  { 2.58, 3.603, 4.537, 5.471, 5.738, 5.961 },
  { 3.069, 4.181, 5.204, 6.272, 6.539, 6.494 },
  { 3.559, 4.804, 6.094, 7.073, 7.429, 7.251 },
  { 4.048, 5.382, 6.761, 8.007, 8.229, 8.007 },
  { 4.582, 6.139, 7.517, 8.896, 8.985, 8.719 },
  { 5.115, 6.717, 8.318, 9.742, 9.964, 9.564 },
  { 5.694, 7.429, 9.03, 10.765, 11.121, 10.409 },
  { 6.272, 8.14, 9.786, 11.61, 12.01, 11.476 },
  { 6.895, 8.763, 10.72, 12.544, 12.944, 12.544 },
  { 7.473, 9.475, 11.788, 13.612, 13.967, 13.523 },
  { 8.096, 10.186, 12.544, 14.546, 15.079, 14.99 },
  { 8.719, 11.165, 13.389, 15.569, 16.458, 16.103 },
  { 9.297, 11.743, 14.323, 16.592, 17.526, 17.659 },
  { 9.519, 12.544, 15.213, 17.882, 18.816, 18.816 },
  { 10.542, 13.256, 16.192, 18.949, 19.972, 20.284 },
  { 11.432, 14.056, 17.259, 20.061, 21.307, 21.574 },
  { 11.832, 14.99, 18.149, 21.351, 22.375, 22.819 },
  { 12.499, 16.014, 19.261, 22.33, 23.842, 24.732 },
  { 13.3, 16.77, 20.462, 23.842, 25.355, 26.111 },
  { 14.012, 17.837, 21.174, 25.266, 26.912, 27.712 },
  { 14.946, 18.683, 22.241, 26.778, 28.113, 29.358 },
  { 15.48, 19.261, 23.798, 27.846, 29.536, 30.737 },
  { 16.236, 20.462, 25.132, 29.18, 30.871, 32.161 },
  { 16.948, 21.351, 26.067, 30.47, 32.027, 33.762 },
  { 17.659, 22.286, 27.268, 31.538, 33.895, 35.719 },
  { 18.416, 23.531, 28.78, 33.095, 35.586, 37.721 },
  { 19.528, 24.599, 29.892, 34.429, 37.187, 40.212 },
  { 20.195, 25.666, 31.271, 36.12, 39.411, 42.436 },
  { 20.818, 26.6, 32.605, 37.454, 41.279, 44.66 },
  { 21.707, 27.89, 33.54, 38.788, 43.237, 47.285 },
  { 22.597, 28.735, 34.963, 40.657, 45.772, 49.242 },
  { 23.62, 29.848, 36.164, 42.214, 47.685, 51.021 },
  { 24.332, 30.96, 37.632, 44.215, 49.197, 54.135 },
  { 25.31, 31.983, 39.055, 45.594, 51.066, 56.003 },
  { 25.978, 33.139, 40.301, 46.929, 52.8, 58.138 },
  { 26.823, 33.806, 41.324, 48.352, 54.891, 60.095 },
  { 27.668, 35.007, 42.97, 49.776, 56.581, 62.408 },
  { 28.38, 36.342, 44.215, 50.754, 57.827, 64.277 },
  { 28.691, 36.423, 44.364, 51.436, 58.998, 65.923 },
};

/* Where VALUE lies on a table of N that begins at FIRST: the place, and the share to the next.  */
static int
place_in_table (double value, double first, double step, int n, double *share)
{
  double s = fmax (0, fmin (n - 1, (value - first) / step));
  int i = s < n - 2 ? (int)s : n - 2;
  *share = s - i;
  return i;
}

/* A voltage: between columns K and K + 1, by SHARE nearer to the next.  */
typedef struct column
{
  int k;
  double share;
} column;

static column
column_of (double volts)
{
  column c;
  c.k = place_in_table (volts, VOLTS_LEAST, VOLTS_STEP, VOLTAGES, &c.share);
  return c;
}

static double
at_row (int row, column c)
{
  return (1 - c.share) * t200[row][c.k] + c.share * t200[row][c.k + 1];
}

static double
t200_force (double volts, double command)
{
  double share;
  column c = column_of (volts);
  int i = place_in_table (command, -1, 2.0 / (PULSES - 1), PULSES, &share);
  return (1 - share) * at_row (i, c) + share * at_row (i + 1, c);
}

/* The size of the force ROW rows from zero outward.  */
static double
outward (int row, int way, column c)
{
  return fabs (at_row (PULSES / 2 + way * row, c));
}

/* Bisection on the rising table, from zero outward: a force of 0 has the command 0.  A step is
   taken or not by arithmetic: a processor cannot foretell which, and thrusters need not wait for
   each other.  */
static double
t200_command (double volts, double force)
{
  int zero = PULSES / 2, way = force < 0 ? -1 : 1, low = 0;
  double size = fabs (force);
  if (force == 0)
    return 0;
  column c = column_of (volts);
  for (int step = 32; step > 0; step /= 2)
    {
      int next = low + step < zero ? low + step : zero - 1;
      low += (next - low) * (outward (next, way, c) < size);
    }
  double least = outward (low, way, c), most = outward (low + 1, way, c);
  double share = most > least ? bt__clamp ((size - least) / (most - least), 0, 1) : 1;
  return way * (low + share) / zero;
}

double
bt__thruster_force (const bt__thruster *thruster, double volts, double command)
{
  double c = fmax (-1, fmin (1, command));
  if (!(fabs (c) > thruster->dead))
    return 0;
  if (thruster->map == BT_MAP_T200)
    return t200_force (volts, c);
  return c > 0 ? thruster->ahead * c * c : -thruster->astern * c * c;
}

double
bt__thruster_command (const bt__thruster *thruster, double volts, double force)
{
  double f = fmax (-thruster->astern, fmin (thruster->ahead, force));
  if (thruster->map == BT_MAP_T200)
    return t200_command (volts, f);
  return f > 0 ? sqrt (f / thruster->ahead) : f < 0 ? -sqrt (-f / thruster->astern) : 0;
}

double
bt__thruster_nearest (const bt__thruster *thruster, double volts, double force)
{
  double f = bt__clamp (force, -thruster->astern, thruster->ahead);
  if (thruster->map != BT_MAP_T200)
    return f;
  column c = column_of (volts);
  return bt__clamp (f, at_row (0, c), at_row (PULSES - 1, c));
}
