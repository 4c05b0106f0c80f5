/* Bullet: its quantised tree over the triangles, with its own contacts of a capsule, and with our
   distance for the triangles whose boxes it finds.  Bullet counts in floats.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <btBulletCollisionCommon.h>
#include <set>
#include <vector>

#include "rivals.h"

namespace
{
btVector3
of (bt_vec3 p)
{
  return btVector3 (btScalar (p.x), btScalar (p.y), btScalar (p.z));
}

struct world
{
  const jacket *soup;
  std::vector<btScalar> v;
  btTriangleIndexVertexArray array;
  btBvhTriangleMeshShape *shape;
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher;
  btDbvtBroadphase broad;
  btCollisionWorld all;
  btCollisionObject object;

  explicit world (const jacket *j)
      : soup (j), dispatcher (&configuration), all (&dispatcher, &broad, &configuration)
  {
    for (uint32_t i = 0; i < j->vertices; i++)
      {
        v.push_back (btScalar (j->v[i].x));
        v.push_back (btScalar (j->v[i].y));
        v.push_back (btScalar (j->v[i].z));
      }
    btIndexedMesh mesh;
    mesh.m_numTriangles = static_cast<int> (j->triangles);
    mesh.m_triangleIndexBase = reinterpret_cast<const unsigned char *> (j->corner);
    mesh.m_triangleIndexStride = sizeof *j->corner;
    mesh.m_numVertices = static_cast<int> (j->vertices);
    mesh.m_vertexBase = reinterpret_cast<const unsigned char *> (v.data ());
    mesh.m_vertexStride = 3 * sizeof (btScalar);
    mesh.m_vertexType = PHY_FLOAT;
    array.addIndexedMesh (mesh, PHY_INTEGER);
    shape = new btBvhTriangleMeshShape (&array, true);
    shape->setMargin (0);
    object.setCollisionShape (shape);
    all.addCollisionObject (&object);
  }

  ~world ()
  {
    all.removeCollisionObject (&object);
    delete shape;
  }
};

void *
build (const jacket *j)
{
  return new world (j);
}

void
drop (void *built)
{
  delete static_cast<world *> (built);
}

/* ---- Its own contacts ---- */

struct collector : btCollisionWorld::ContactResultCallback
{
  std::set<int> found;

  btScalar addSingleResult (btManifoldPoint &, const btCollisionObjectWrapper *, int, int triangle,
                            const btCollisionObjectWrapper *, int, int other) override
  {
    found.insert (triangle >= 0 ? triangle : other);
    return 0;
  }
};

rival_answer
contact_frame (void *built, const bt_vec3 *x, int n, double reach)
{
  world *w = static_cast<world *> (built);
  rival_answer answer = { 0, 0 };
  for (int i = 0; i < n; i++)
    {
      btVector3 a = of (x[i]), b = of (x[i + 1]), along = b - a;
      btCapsuleShapeZ link (btScalar (reach), along.length ());
      btCollisionObject moving;
      moving.setCollisionShape (&link);
      moving.setWorldTransform (btTransform (
          shortestArcQuat (btVector3 (0, 0, 1), along.normalized ()), btScalar (0.5) * (a + b)));
      collector all;
      w->all.contactPairTest (&w->object, &moving, all);
      answer.pairs += static_cast<long> (all.found.size ());
      for (int k : all.found)
        answer.sum += static_cast<uint64_t> (k);
    }
  return answer;
}

/* ---- Its tree alone ---- */

struct measurer : btTriangleCallback
{
  const jacket *soup;
  bt_vec3 a, b;
  double reach;
  rival_answer *answer;

  void processTriangle (btVector3 *, int, int triangle) override
  {
    const uint32_t *c = soup->corner[triangle];
    bt_vec3 t[3] = { soup->v[c[0]], soup->v[c[1]], soup->v[c[2]] };
    if (!rival_measure (t, a, b, reach))
      return;
    answer->pairs++;
    answer->sum += static_cast<uint64_t> (triangle);
  }
};

rival_answer
tree_frame (void *built, const bt_vec3 *x, int n, double reach)
{
  world *w = static_cast<world *> (built);
  rival_answer answer = { 0, 0 };
  for (int i = 0; i < n; i++)
    {
      measurer each;
      btVector3 lo = of (x[i]), hi = lo, b = of (x[i + 1]);
      btScalar more = btScalar (reach * 1.001);
      lo.setMin (b);
      hi.setMax (b);
      each.soup = w->soup;
      each.a = x[i];
      each.b = x[i + 1];
      each.reach = reach;
      each.answer = &answer;
      w->shape->processAllTriangles (&each, lo - btVector3 (more, more, more),
                                     hi + btVector3 (more, more, more));
    }
  return answer;
}
}

extern "C" const rival rival_bullet_contact
    = { "Bullet contactPairTest", build, contact_frame, drop };
extern "C" const rival rival_bullet_tree
    = { "Bullet tree with our distance", build, tree_frame, drop };
