/* FCL: a mesh of OBBRSS boxes (Gottschalk, Lin, Manocha 1996; Larsen et al. 1999), each link a
   capsule that grows by the reach.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <fcl/fcl.h>

#include "rivals.h"

namespace
{
using model = fcl::BVHModel<fcl::OBBRSS<double> >;

fcl::Vector3d
of (bt_vec3 p)
{
  return fcl::Vector3d (p.x, p.y, p.z);
}

void *
build (const jacket *j)
{
  std::vector<fcl::Vector3d> v;
  std::vector<fcl::Triangle> t;
  v.reserve (j->vertices);
  t.reserve (j->triangles);
  for (uint32_t i = 0; i < j->vertices; i++)
    v.push_back (of (j->v[i]));
  for (uint32_t i = 0; i < j->triangles; i++)
    t.emplace_back (j->corner[i][0], j->corner[i][1], j->corner[i][2]);
  model *m = new model;
  m->beginModel (static_cast<int> (t.size ()), static_cast<int> (v.size ()));
  m->addSubModel (v, t);
  m->endModel ();
  return m;
}

rival_answer
frame (void *built, const bt_vec3 *x, int n, double reach)
{
  const model *m = static_cast<const model *> (built);
  rival_answer answer = { 0, 0 };
  fcl::CollisionRequest<double> request (1000000, false);
  for (int i = 0; i < n; i++)
    {
      fcl::Vector3d a = of (x[i]), b = of (x[i + 1]), along = b - a;
      fcl::Capsule<double> link (reach, along.norm ());
      fcl::Transform3d at = fcl::Transform3d::Identity ();
      at.linear ()
          = fcl::Quaterniond::FromTwoVectors (fcl::Vector3d::UnitZ (), along).toRotationMatrix ();
      at.translation () = 0.5 * (a + b);
      fcl::CollisionResult<double> result;
      fcl::collide (m, fcl::Transform3d::Identity (), &link, at, request, result);
      answer.pairs += static_cast<long> (result.numContacts ());
      for (size_t k = 0; k < result.numContacts (); k++)
        answer.sum += static_cast<uint64_t> (result.getContact (k).b1);
    }
  return answer;
}

void
drop (void *built)
{
  delete static_cast<model *> (built);
}
}

extern "C" const rival rival_fcl = { "FCL OBBRSS collide", build, frame, drop };
