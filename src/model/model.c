/* Compile a world into a model.  The compiler is the validator: the engine can run every compiled
   model.

   Every field of every part is checked by the table of fields (fields.c), then parts together:
   names unique, ends resolved to vehicles or points, lengths long enough for the laying, figures
   that no line can have refused, the sum of nodes bounded.  A model is immutable and counted by
   reference.  Its id is a hash of sea, vehicles, tethers and obstacles; states carry the id and are
   restored into dives of the same id alone.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/hash.h"
#include "math/vec.h"
#include "model/compile.h"

static double
displaced_by (const bt_tether_props *props, double density)
{
  return density * BT__PI / 4 * props->diameter * props->diameter;
}

double
bt_tether_least_mass (const bt_tether_props *props, double density, double gravity)
{
  double lift = gravity > 0 && props->wet_weight < 0 ? -props->wet_weight / gravity : 0;
  return fmax (displaced_by (props, density), lift) / BT_LIGHTEST;
}

void
bt_tether_props_complete (bt_tether_props *props, double density, double gravity)
{
  double displaced = displaced_by (props, density);
  if (isnan (props->mass) && isnan (props->wet_weight))
    props->wet_weight = 0;
  if (isnan (props->wet_weight))
    props->wet_weight = (props->mass - displaced) * gravity;
  else if (isnan (props->mass))
    props->mass = fmax (displaced + (gravity > 0 ? props->wet_weight / gravity : 0),
                        bt_tether_least_mass (props, density, gravity));
}

bt_status
bt__check_mass (const bt_tether_props *props, const char *name, double density, double gravity,
                bt_error *error)
{
  double least = bt_tether_least_mass (props, density, gravity);
  if (props->mass >= least * (1 - 1e-9)) /* a rounding's tolerance */
    return BT_OK;
  return bt__fail (error, BT_ERR_DOMAIN,
                   "`mass' of tether `%s' is %g kg/m; with `diameter' %g m and `wet-weight' %g N/m "
                   "the least there is is %.3g: a %gth of the water that it displaces, or that its "
                   "lift would carry, for lighter foam is crushed by a few metres of water",
                   name, props->mass, props->diameter, props->wet_weight, least, BT_LIGHTEST);
}

/* ---- The parts together ---- */

static int
find_vehicle (const bt_model *model, const char *name)
{
  for (int i = 0; i < model->n_vehicles; i++)
    if (strncmp (model->vehicles[i].name, name, BT_NAME_SIZE) == 0)
      return i;
  return BT__NOT_A_VEHICLE;
}

static bt_status
resolve_end (const bt_model *model, const bt_tether_def *tether, const bt_end *def,
             const char *which, bt__end *end, bt_error *error)
{
  end->vehicle = BT__NOT_A_VEHICLE;
  end->at = def->at;
  if (!def->part[0])
    return BT_OK;
  end->vehicle = find_vehicle (model, def->part);
  if (end->vehicle == BT__NOT_A_VEHICLE && bt__model_obstacle (model, def->part) != BT__NO_OBSTACLE)
    return bt__fail (error, BT_ERR_DEF,
                     "tether `%s' goes %s `%.63s', an obstacle: an end is a vehicle or a point",
                     tether->name, which, def->part);
  if (end->vehicle == BT__NOT_A_VEHICLE)
    return bt__fail (error, BT_ERR_DEF, "tether `%s' goes %s `%.63s', but no vehicle has that name",
                     tether->name, which, def->part);
  end->at = bt__attached_at (&model->vehicles[end->vehicle]);
  return BT_OK;
}

double
bt__longest_chord (const bt_tether_props *props, double length, double pull)
{
  int stretches = props->model >= BT_MODEL_ELASTIC && isfinite (props->ea);
  double most = fmin (pull, props->breaking_load);
  return stretches ? length * (1 + fmin (most / props->ea, 0.1)) : length;
}

static bt_status
check_reach (const bt_model *model, int i, bt_error *error)
{
  const bt_tether_def *tether = &model->tethers[i];
  bt_vec3 p[BT_VIA_MAX + 2];
  int n = bt__lay_points (model, i, p);
  double way = 0;
  for (int k = 0; k + 1 < n; k++)
    way += bt__distance (p[k], p[k + 1]);
  /* A rounding's tolerance, so that a world with a length equal to the chord is accepted.  */
  if (way <= bt__longest_chord (&tether->props, tether->length, INFINITY) * (1 + 1e-12))
    return BT_OK;
  if (n > 2)
    return bt__fail (error, BT_ERR_DEF,
                     "tether `%s' is %g m long, but its way through its `via' is %g m",
                     tether->name, tether->length, way);
  return bt__fail (error, BT_ERR_DEF, "tether `%s' is %g m long, but its ends are %g m apart",
                   tether->name, tether->length, way);
}

static int
compare_names (const void *a, const void *b)
{
  return strncmp (*(const char *const *)a, *(const char *const *)b, BT_NAME_SIZE);
}

static int
list_names (const bt_model *model, const char **names)
{
  int n = 0;
  for (int i = 0; i < model->n_vehicles; i++)
    names[n++] = model->vehicles[i].name;
  for (int i = 0; i < model->n_tethers; i++)
    names[n++] = model->tethers[i].name;
  for (int i = 0; i < model->n_obstacles; i++)
    names[n++] = model->obstacles[i].name;
  return n;
}

static bt_status
check_unique (const bt_model *model, bt_error *error)
{
  size_t room = (size_t)(model->n_vehicles + model->n_tethers + model->n_obstacles);
  const char **names = malloc (room * sizeof *names + 1);
  bt_status status = BT_OK;
  int n;
  if (!names)
    return bt__fail (error, BT_ERR_LIMIT, "no memory for the names of a world");
  n = list_names (model, names);
  qsort (names, (size_t)n, sizeof *names, compare_names);
  for (int i = 1; i < n && status == BT_OK; i++)
    if (compare_names (&names[i - 1], &names[i]) == 0)
      status = bt__fail (error, BT_ERR_DEF, "two parts are named `%s'", names[i]);
  free (names);
  return status;
}

/* Static shapes know nothing of lumps: a line that has some is a moving one.  */
static bt_status
check_lumps (const bt_tether_def *tether, bt_error *error)
{
  int n = (int)tether->n_lumps;
  if (!(tether->n_lumps >= 0 && tether->n_lumps <= BT_LUMPS_MAX))
    return bt__fail (error, BT_ERR_LIMIT, "tether `%s' has at most %d clumps and floats",
                     tether->name, BT_LUMPS_MAX);
  if (n > 0 && tether->props.model < BT_MODEL_DYNAMIC)
    return bt__fail (error, BT_ERR_UNSUPPORTED,
                     "tether `%s' has clumps or floats: its model must be `dynamic' or `auto'",
                     tether->name);
  for (int k = 0; k < n; k++)
    {
      const bt_lump *lump = &tether->lumps[k];
      if (!(lump->at - lump->span / 2 >= 0 && lump->at + lump->span / 2 <= tether->length))
        return bt__fail (error, BT_ERR_DEF,
                         "what is fastened at %g m does not lie on the %g m of tether `%s'",
                         lump->at, tether->length, tether->name);
      if (!(lump->mass >= 0 && lump->mass <= 1e5 && lump->buoyancy >= 0 && lump->buoyancy <= 1e6))
        return bt__fail (error, BT_ERR_DOMAIN,
                         "what is fastened at %g m of tether `%s' has no such mass or buoyancy",
                         lump->at, tether->name);
    }
  return BT_OK;
}

#define SET_TURN 1.0 /* radians: the most that a set may turn a line within one interval */

static double
number_of (const bt_tether_def *def, const bt_field *field)
{
  double value;
  memcpy (&value, (const char *)def + field->offset, sizeof value);
  return value;
}

/* Refuse DEF, called NAME, if a field is more than another lets it be.  */
static bt_status
check_bounds (const bt_tether_def *def, const char *name, bt_error *error)
{
  const bt_head *head = bt_head_find ("tether");
  size_t n;
  const bt_bound *all = bt_bounds (&n);
  for (const bt_bound *b = all; b < all + n; b++)
    {
      const bt_field *field = bt_field_find (head, b->field), *of = bt_field_find (head, b->of);
      double is = number_of (def, field), other = number_of (def, of),
             most = fmax (b->factor * pow (other, b->power), b->floor);
      if (isfinite (is) && !(is <= most))
        return bt__fail (error, BT_ERR_DOMAIN,
                         "`%s' of tether `%s' is %g %s; with `%s' %g %s the most there is is %.3g; "
                         "%s",
                         b->field, name, is, field->unit, b->of, other, of->unit, most, b->why);
    }
  return BT_OK;
}

static bt_status
check_layers (const bt_tether_props *p, const bt_tether_def *tether, bt_error *error)
{
  if (p->ei_stuck > 0 && !(p->ei > 0 && p->ei_stuck >= p->ei))
    return bt__fail (
        error, BT_ERR_DOMAIN,
        "`ei-stuck' of tether `%s' is %g N m2, `ei' %g: it is stiffest while its layers "
        "stick, and has an `ei' of more than 0 while they slip",
        tether->name, p->ei_stuck, p->ei);
  if (p->ei_stuck > 0 && tether->n_sets > 0)
    return bt__fail (error, BT_ERR_UNSUPPORTED,
                     "tether `%s' has a set and layers that slip; a line may have one of them. "
                     "Without `ei-stuck' it keeps its set",
                     tether->name);
  return BT_OK;
}

/* A set and a clamp are affairs of bending, in a line that moves.  */
bt_status
bt__bears_bends (const bt_tether_props *p, const bt_tether_def *tether, bt_error *error)
{
  bt_tether_def def = { .props = *p };
  bt_status status = check_bounds (&def, tether->name, error);
  if (status == BT_OK)
    status = check_layers (p, tether, error);
  if (status != BT_OK)
    return status;
  const char *has = tether->n_sets > 0 ? "has a set" : "is clamped";
  if (!(tether->n_sets > 0) && !bt__is_clamped (tether, 0) && !bt__is_clamped (tether, 1))
    return BT_OK;
  if (p->model < BT_MODEL_DYNAMIC)
    return bt__fail (error, BT_ERR_UNSUPPORTED,
                     "tether `%s' %s: its model must be `dynamic' or `auto'", tether->name, has);
  if (!(p->ei > 0))
    return bt__fail (error, BT_ERR_UNSUPPORTED,
                     "tether `%s' %s, which is a bend that its stiffness holds: it needs an `ei' "
                     "of more than 0",
                     tether->name, has);
  return BT_OK;
}

/* The moment of a clamp would turn a vehicle with mass; no vehicle is told.  */
static bt_status
check_clamps (const bt_model *model, int i, bt_error *error)
{
  const bt_tether_def *tether = &model->tethers[i];
  for (int k = 0; k < 2; k++)
    {
      int vehicle = model->ends[i][k].vehicle;
      if (vehicle >= 0 && bt__is_clamped (tether, k) && model->vehicles[vehicle].mass > 0)
        return bt__fail (error, BT_ERR_UNSUPPORTED,
                         "tether `%s' is clamped to `%s', which has mass; a clamp holds a line at "
                         "a point, or at a vehicle without mass",
                         tether->name, model->vehicles[vehicle].name);
    }
  return BT_OK;
}

static bt_status
check_sets (const bt_tether_def *tether, bt_error *error)
{
  const bt_tether_props *p = &tether->props;
  double turn = 0;
  if (!(tether->n_sets >= 0 && tether->n_sets <= BT_SETS_MAX))
    return bt__fail (error, BT_ERR_LIMIT, "tether `%s' has at most %d sets", tether->name,
                     BT_SETS_MAX);
  bt_status status = bt__bears_bends (p, tether, error);
  if (status)
    return status;
  for (int k = 0; k < (int)tether->n_sets; k++)
    {
      const bt_set *set = &tether->sets[k];
      if (!(set->at >= 0 && set->at <= tether->length))
        return bt__fail (error, BT_ERR_DEF, "a set at %g m does not lie on the %g m of tether `%s'",
                         set->at, tether->length, tether->name);
      if (!(set->curvature >= 0 && set->curvature <= 1000 && isfinite (set->plane)
            && set->span > 0))
        return bt__fail (error, BT_ERR_DOMAIN,
                         "a set of tether `%s' has no such curvature or place", tether->name);
      turn = fmax (turn, set->curvature * fmin (set->span, tether->length / p->nodes));
    }
  if (turn > SET_TURN && p->model == BT_MODEL_DYNAMIC)
    return bt__fail (error, BT_ERR_DEF,
                     "a set turns tether `%s' by %.3g radians within an interval; at most %g are "
                     "followed: `nodes' of %g or more",
                     tether->name, turn, SET_TURN, ceil (turn / SET_TURN * p->nodes));
  return BT_OK;
}

#define STRETCH_MAX 10.0 /* times the length: the most a line may stretch by its weight */
#define NODES_ANYWAY 200 /* allowed for any line, however short */

/* Refuse combinations of figures that no line can have, though each figure is in range.  */
static bt_status
check_figures (const bt_tether_def *tether, bt_error *error)
{
  const bt_tether_props *p = &tether->props;
  double weight = fabs (p->wet_weight) * tether->length;
  double most = fmax (NODES_ANYWAY, floor (tether->length / p->diameter));
  if (weight > STRETCH_MAX * p->ea)
    return bt__fail (
        error, BT_ERR_DOMAIN,
        "%g m of tether `%s' weigh %.3g N in water, which stretches an `ea' of %g N to "
        "more than %g times its length",
        tether->length, tether->name, weight, p->ea, STRETCH_MAX);
  if (p->nodes > most)
    return bt__fail (error, BT_ERR_LIMIT,
                     "%g `nodes' divide %g m of tether `%s' more finely than it is thick, %g m; at "
                     "most %g are allowed",
                     p->nodes, tether->length, tether->name, p->diameter, most);
  return BT_OK;
}

/* List the tethers by the vehicles at their far ends, in order.  */
static void
list_led (bt_model *model)
{
  for (int v = 0; v < model->n_vehicles; v++)
    model->led[v] = -1;
  for (int i = model->n_tethers - 1; i >= 0; i--)
    {
      int vehicle = model->ends[i][1].vehicle;
      model->led_too[i] = vehicle < 0 ? -1 : model->led[vehicle];
      if (vehicle >= 0)
        model->led[vehicle] = i;
    }
}

static bt_status
compile_tether (bt_model *model, int i, bt_error *error)
{
  bt_tether_def *tether = &model->tethers[i];
  bt_status status = bt__check_name ("tether", tether->name, error);
  if (status == BT_OK && isnan (tether->length))
    status = bt__fail (error, BT_ERR_DEF, "tether `%s' needs a length", tether->name);
  if (status == BT_OK)
    {
      bt_tether_props_complete (&tether->props, model->sea.density, model->sea.gravity);
      status = bt__check_def (bt_head_find ("tether"), tether->name, tether, error);
    }
  if (status == BT_OK)
    status = bt__check_mass (&tether->props, tether->name, model->sea.density, model->sea.gravity,
                             error);
  if (status == BT_OK)
    status = check_figures (tether, error);
  if (status == BT_OK)
    status = resolve_end (model, tether, &tether->from, "from", &model->ends[i][0], error);
  if (status == BT_OK)
    status = resolve_end (model, tether, &tether->to, "to", &model->ends[i][1], error);
  if (status == BT_OK && model->ends[i][0].vehicle >= 0
      && model->ends[i][0].vehicle == model->ends[i][1].vehicle)
    status = bt__fail (error, BT_ERR_DEF, "tether `%s' goes from `%s' to itself", tether->name,
                       tether->from.part);
  if (status == BT_OK)
    status = check_lumps (tether, error);
  if (status == BT_OK)
    status = check_sets (tether, error);
  if (status == BT_OK)
    status = check_clamps (model, i, error);
  if (status == BT_OK && tether->length > tether->drum)
    status = bt__fail (error, BT_ERR_DEF, "%g m of tether `%s' are out, of %g m on its drum",
                       tether->length, tether->name, tether->drum);
  return status == BT_OK ? check_reach (model, i, error) : status;
}

static bt_status
compile_world (bt_model *model, const bt_world *world, bt_error *error)
{
  bt_status status = bt__check_def (bt_head_find ("sea"), "", &model->sea, error);
  for (int i = 0; status == BT_OK && i < model->n_vehicles; i++)
    {
      status = bt__check_name ("rov", model->vehicles[i].name, error);
      if (status == BT_OK)
        status = bt__check_def (bt_head_find ("rov"), model->vehicles[i].name, &model->vehicles[i],
                                error);
      if (status == BT_OK)
        status = bt__compile_vehicle (&model->vehicles[i], model->sea.density, &model->types[i],
                                      &model->rigs[i], error);
    }
  if (status == BT_OK)
    status = bt__compile_obstacles (model, world, error);
  if (status == BT_OK)
    status = bt__compile_sea (model, error);
  for (int i = 0; status == BT_OK && i < model->n_tethers; i++)
    status = compile_tether (model, i, error);
  if (status == BT_OK)
    list_led (model);
  if (status == BT_OK)
    status = bt__compile_hulls (model, error);
  if (status == BT_OK)
    status = check_unique (model, error);
  return status == BT_OK ? bt__check_laying (model, error) : status;
}

/* ---- Life ---- */

static uint64_t
content_id (const bt_model *model, const bt_world *world)
{
  uint64_t h = bt__hash_sea (&model->sea, 0);
  h = bt__hash (model->vehicles, sizeof *model->vehicles * (size_t)model->n_vehicles, h);
  h = bt__hash_rows (model->tethers, (size_t)model->n_tethers, offsetof (bt_tether_def, sets),
                     sizeof *model->tethers, h);
  for (int i = 0; i < model->n_tethers; i++)
    if (model->tethers[i].n_sets > 0)
      h = bt__hash (model->tethers[i].sets, sizeof model->tethers[i].sets, h + (uint64_t)i);
  for (int i = 0; i < model->n_tethers; i++)
    if (bt__is_clamped (&model->tethers[i], 0) || bt__is_clamped (&model->tethers[i], 1))
      h = bt__hash (model->tethers[i].along, sizeof model->tethers[i].along, h + (uint64_t)i);
  return bt__hash_obstacles (world, h);
}

static bt_status
check_nodes (const bt_world *world, bt_error *error)
{
  double sum = 0;
  for (int i = 0; i < world->n_tethers; i++)
    sum += world->tethers[i].props.nodes;
  if (!(sum > BT_NODES_SUM_MAX))
    return BT_OK;
  return bt__fail (
      error, BT_ERR_LIMIT,
      "the tethers of a world have at most %d `nodes' together, not %g: it would not fit "
      "into memory",
      BT_NODES_SUM_MAX, sum);
}

static bt_status
check_part_counts (const bt_world *world, bt_error *error)
{
  if (world->n_vehicles < 0 || world->n_vehicles > BT_VEHICLES_MAX)
    return bt__fail (error, BT_ERR_LIMIT, "a world has at most %d vehicles, not %d",
                     BT_VEHICLES_MAX, world->n_vehicles);
  if (world->n_tethers < 0 || world->n_tethers > BT_TETHERS_MAX)
    return bt__fail (error, BT_ERR_LIMIT, "a world has at most %d tethers, not %d", BT_TETHERS_MAX,
                     world->n_tethers);
  return check_nodes (world, error);
}

/* Copy N items of SIZE bytes.  For N = 0 the copy has one unused byte: NULL always means that
   memory ran out.  */
static void *
copy_of (const void *items, int n, size_t size)
{
  size_t bytes = size * (size_t)n;
  void *copy = malloc (bytes + 1);
  if (copy && bytes > 0)
    memcpy (copy, items, bytes);
  return copy;
}

static bt_model *
model_of (const bt_world *world)
{
  bt_model *model = calloc (1, sizeof *model);
  if (!model)
    return NULL;
  atomic_init (&model->references, 1);
  model->sea = world->sea;
  bt_current_grid_retain (model->sea.grid);
  model->n_vehicles = world->n_vehicles;
  model->n_tethers = world->n_tethers;
  model->vehicles = copy_of (world->vehicles, world->n_vehicles, sizeof *world->vehicles);
  model->tethers = copy_of (world->tethers, world->n_tethers, sizeof *world->tethers);
  model->ends = calloc ((size_t)world->n_tethers + 1, sizeof *model->ends);
  model->led = calloc ((size_t)world->n_vehicles + 1, sizeof *model->led);
  model->led_too = calloc ((size_t)world->n_tethers + 1, sizeof *model->led_too);
  model->types = calloc ((size_t)world->n_vehicles + 1, sizeof *model->types);
  model->rigs = calloc ((size_t)world->n_vehicles + 1, sizeof *model->rigs);
  if (model->vehicles && model->tethers && model->ends && model->led && model->led_too
      && model->types && model->rigs)
    return model;
  bt_model_release (model);
  return NULL;
}

bt_status
bt_model_new_polled (const bt_world *world, bt_poll poll, void *poll_user, bt_model **out,
                     bt_error *error)
{
  bt__asker asker = { .poll = poll, .user = poll_user };
  bt_model *model;
  bt_status status = check_part_counts (world, error);
  if (status != BT_OK)
    return status;
  model = model_of (world);
  if (!model)
    return bt__fail (error, BT_ERR_LIMIT, "no memory for a world");
  model->asker = &asker;
  status = compile_world (model, world, error);
  model->asker = NULL;
  if (status == BT_OK)
    {
      model->id = content_id (model, world);
      bt__number_scenes (model);
      *out = model;
    }
  else
    bt_model_release (model);
  return status;
}

bt_status
bt_model_new (const bt_world *world, bt_model **out, bt_error *error)
{
  return bt_model_new_polled (world, NULL, NULL, out, error);
}

bt_model *
bt_model_retain (bt_model *model)
{
  atomic_fetch_add (&model->references, 1);
  return model;
}

void
bt_model_release (bt_model *model)
{
  if (!model || atomic_fetch_sub (&model->references, 1) > 1)
    return;
  bt_current_grid_free (model->sea.grid);
  bt_lees_free (model->lees);
  free (model->vehicles);
  free (model->types);
  free (model->rigs);
  free (model->tethers);
  free (model->ends);
  free (model->led);
  free (model->led_too);
  bt__release_obstacles (model);
  bt__release_hulls (model);
  free (model);
}
