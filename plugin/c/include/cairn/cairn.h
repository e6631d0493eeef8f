/* SPDX-License-Identifier: Zlib */
/** @file
 * Cairn in C: certified sphere-trees, and worlds in which they collide under a budget. For programs in C99 and later,
 * and for bindings of other languages. Link libcairn_c.
 *
 * Units are metres, kilograms, seconds and radians. A rotation is a unit quaternion x, y, z, w. A function that can
 * fail returns null, 0 or a negative number, and `cairnError` then has the reason. Trees and shapes may be used by
 * several threads, a world by one at a time. Places lie within 1e6 m, velocities and gravity within 1e4, bodies are
 * 1e-4 to 1e5 m across: beyond them single precision loses what a step needs, and they are refused. Null may be passed
 * to every function whose name begins with `cairnFree`, and to no other unless it says so.
 *
 *     CairnTree* tree = cairnLoadTree("rock.cairn");
 *     if (!tree) return fail(cairnError());
 *     CairnShape* shape = cairnMakeShape(tree, NULL);
 *     CairnWorld* world = cairnMakeWorld(NULL);
 *     const CairnBudget budget = {20000, CAIRN_NO_LIMIT};
 *     cairnSetBudget(world, &budget);
 *     const CairnPose above = {{0, 2, 0}, {0, 0, 0, 1}};
 *     const float up[3] = {0, 1, 0};
 *     cairnAddPlane(world, up, 0, NULL);
 *     cairnAddBody(world, shape, 1, &above, NULL);
 *     cairnStep(world);
 */
#ifndef CAIRN_CAIRN_H
#define CAIRN_CAIRN_H

#include <stddef.h>
#include <stdint.h>

/** @cond */
#if defined(_WIN32) && defined(CAIRN_SHARED)
#ifdef cairn_c_EXPORTS
#define CAIRN_C_EXPORT __declspec(dllexport)
#else
#define CAIRN_C_EXPORT __declspec(dllimport)
#endif
#elif defined(_WIN32)
#define CAIRN_C_EXPORT
#else
#define CAIRN_C_EXPORT __attribute__((visibility("default")))
#endif

/** @endcond */

#ifdef __cplusplus
extern "C" {
#endif

/** A certified sphere-tree. It never changes. */
typedef struct CairnTree CairnTree;
/** A tree at a scale, as the shape of any number of bodies. */
typedef struct CairnShape CairnShape;
/** Bodies of trees between planes and boxes, with a narrow phase and a solver. */
typedef struct CairnWorld CairnWorld;

/** @def CAIRN_NO_LIMIT
 * The amount that means no limit. */
#define CAIRN_NO_LIMIT (-1)

/** Where something is. Of a body: where its mesh's own frame is. */
typedef struct CairnPose {
  float position[3]; /**< of the frame's origin, world */
  float rotation[4]; /**< unit quaternion x, y, z, w */
} CairnPose;

/** A ball of a tree's level. */
typedef struct CairnSphere {
  float center[3]; /**< in the mesh's frame and unit */
  float radius;    /**< mesh unit */
  float error;     /**< certified, mesh unit: no point of the ball is farther from the solid */
} CairnSphere;

/** What a tree consists of. */
typedef struct CairnTreeInfo {
  uint32_t levels;        /**< below the root */
  uint32_t nodes;         /**< balls, the root included */
  uint32_t leaves;        /**< balls without children */
  uint32_t vertices;      /**< of the source mesh */
  uint32_t triangles;     /**< of the source mesh */
  uint32_t levelMeshes;   /**< levels from 1 on with a coarser mesh of their own */
  uint64_t bytes;         /**< of memory that the tree holds */
  double volume;          /**< of the solid, cubed mesh units */
  double centerOfMass[3]; /**< of the solid, mesh frame */
  double inertia[9];      /**< per kilogram of the solid about its centre, by rows, squared mesh units */
} CairnTreeInfo;

/** How a tree becomes a shape. */
typedef struct CairnShapeOptions {
  float scale; /**< world length of the mesh's unit, > 0; 0 stands for 1 */
  /** How far contacts may be off, as a fraction of the smaller body's size; 0: not at all. The tree needs level meshes.
   */
  float maxContactError;
} CairnShapeOptions;

/** How a world begins. */
typedef struct CairnWorldOptions {
  float gravity[3];         /**< m/s^2; usually (0, -9.81, 0) */
  float timeStep;           /**< s, of `cairnStep`, 1e-5 to 1; usually 1/60 */
  int32_t solverIterations; /**< passes over all contacts in a step, 1 to 1000; usually 10 */
} CairnWorldOptions;

/** What a surface does to another: the values of both are multiplied. */
typedef struct CairnMaterial {
  float friction;    /**< 0 to 100; usually 0.5 */
  float restitution; /**< 0 to 1; usually 0 */
} CairnMaterial;

/** How much work a step may do on pairs of trees. */
typedef struct CairnBudget {
  int64_t operations;  /**< of refinement, or CAIRN_NO_LIMIT; gives the same bits in every run */
  double microseconds; /**< of elapsed time, or CAIRN_NO_LIMIT */
} CairnBudget;

/** What an unresolved pair answers. */
typedef enum CairnUnresolved {
  CAIRN_GUARD = 0,     /**< its last contacts, or spheres that may not come nearer; at first */
  CAIRN_REPEL = 1,     /**< its spheres as they are */
  CAIRN_IGNORE = 2,    /**< its last contacts, and nothing else */
  CAIRN_COMPENSATE = 3 /**< its spheres, less their certified error */
} CairnUnresolved;

/** Where refinement ends. */
typedef enum CairnFinest {
  CAIRN_LEAVES = 0,   /**< at the leaves' spheres */
  CAIRN_TRIANGLES = 1 /**< at the source meshes; at first */
} CairnFinest;

/** A contact point that the last step gave to the solver. */
typedef struct CairnContact {
  float point[3];  /**< on body b, world */
  float normal[3]; /**< unit, from b to a, world */
  float depth;     /**< m; negative where the surfaces are apart */
  float error;     /**< certified, m, of the pair: how far surfaces may be from where its contacts put them */
  float impulse;   /**< of the last step along the normal, N s */
  int32_t a;       /**< the first body's number; planes and boxes are -1, -2 and so on, in the order they were added */
  int32_t b;       /**< the second one's, likewise */
  int32_t isResolved; /**< 1 unless the pair ran out of budget */
} CairnContact;

/** What the last step did. */
typedef struct CairnStatistics {
  uint64_t operations;         /**< all work charged */
  double microseconds;         /**< CPU time of the collision step */
  double elapsedMicroseconds;  /**< elapsed time of the same work */
  double deadlineMicroseconds; /**< time allowed; CAIRN_NO_LIMIT without a limit */
  double missedByMicroseconds; /**< by how much the step exceeded its deadline; 0 if it did not */
  uint32_t pairs;              /**< pairs with a tree whose boxes overlap */
  uint32_t nonFinitePairs;     /**< pairs with a body whose place or speed is NaN or infinite */
  uint32_t unresolvedPairs;    /**< those of `pairs` that were not finished */
  uint32_t contacts;           /**< points given to the solver */
  uint32_t exactContacts;      /**< those of `contacts` measured between source meshes */
  uint32_t manifolds;          /**< groups of contacts */
  double worstErrorFraction;   /**< largest certified error of a pair, as a fraction of its smaller body's size */
  double meanErrorFraction;    /**< mean over the pairs with contacts */
} CairnStatistics;

/** Cairn's version, as "major.minor.patch". */
CAIRN_C_EXPORT const char* cairnVersion(void);
/** Why the last call of this thread that failed did so: one sentence. Valid until the thread's next failure. */
CAIRN_C_EXPORT const char* cairnError(void);
/** Sets where warnings go that no return value can carry; null: standard error, as at first. Any thread may call it. */
CAIRN_C_EXPORT void cairnSetLog(void (*function)(const char* message, void* user), void* user);

/** Reads a `.cairn` file. Nothing in it is trusted. Null where it cannot be read or is damaged. */
CAIRN_C_EXPORT CairnTree* cairnLoadTree(const char* path);
/** The same from memory, which may be freed afterwards. */
CAIRN_C_EXPORT CairnTree* cairnReadTree(const void* bytes, size_t size);
/** Frees a tree. Its shapes keep what they need. */
CAIRN_C_EXPORT void cairnFreeTree(CairnTree* tree);
/** Describes a tree. */
CAIRN_C_EXPORT void cairnDescribeTree(const CairnTree* tree, CairnTreeInfo* info);
/** Writes the balls of a level (0 is the root; leaves above it belong to it) to at most `room` places. Returns how many
 * there are. `spheres` may be null where `room` is 0. */
CAIRN_C_EXPORT size_t cairnTreeSpheres(const CairnTree* tree, uint32_t level, CairnSphere* spheres, size_t room);
/** Copies the source mesh: three numbers for each vertex, in its own frame, and three indices for each triangle. Each
 * array has the length that `cairnDescribeTree` tells; null is passed over. */
CAIRN_C_EXPORT void cairnTreeMesh(const CairnTree* tree, float* vertices, uint32_t* triangles);

/** A shape of a tree, with null for the usual options. Null where an option is out of range. */
CAIRN_C_EXPORT CairnShape* cairnMakeShape(const CairnTree* tree, const CairnShapeOptions* options);
/** Frees a shape. Its bodies keep what they need. */
CAIRN_C_EXPORT void cairnFreeShape(CairnShape* shape);
/** Diagonal of the mesh's box, m: what fractions of a body's size refer to. */
CAIRN_C_EXPORT float cairnShapeSize(const CairnShape* shape);
/** The `btCollisionShape`, for C++ code that uses Bullet. It lives as long as the shape. */
CAIRN_C_EXPORT void* cairnBulletShape(CairnShape* shape);

/** The usual options, to be changed. */
CAIRN_C_EXPORT CairnWorldOptions cairnUsualWorld(void);
/** An empty world, with null for the usual options. Null where an option is out of range. */
CAIRN_C_EXPORT CairnWorld* cairnMakeWorld(const CairnWorldOptions* options);
/** Frees a world with all its bodies. */
CAIRN_C_EXPORT void cairnFreeWorld(CairnWorld* world);
/** The `btDiscreteDynamicsWorld`, for C++ code that uses Bullet. It lives as long as the world. */
CAIRN_C_EXPORT void* cairnBulletWorld(CairnWorld* world);

/** Sets gravity, m/s^2, and wakes all bodies. 0 where it is out of range. */
CAIRN_C_EXPORT int cairnSetGravity(CairnWorld* world, const float gravity[3]);
/** Sets the budget of each step from the next on. 0 for negative amounts other than CAIRN_NO_LIMIT, and for NaN. */
CAIRN_C_EXPORT int cairnSetBudget(CairnWorld* world, const CairnBudget* budget);
/** Sets what unresolved pairs answer, a `CairnUnresolved`. 0 for a number that is no policy. */
CAIRN_C_EXPORT int cairnSetUnresolved(CairnWorld* world, int32_t policy);
/** Sets where refinement ends, a `CairnFinest`. 0 for a number that names no such place. */
CAIRN_C_EXPORT int cairnSetFinest(CairnWorld* world, int32_t finest);

/** Adds the half-space of points whose product with `normal` is below `offset`. A null material is the usual one. */
CAIRN_C_EXPORT int cairnAddPlane(CairnWorld* world, const float normal[3], float offset, const CairnMaterial* material);
/** Adds a box that does not move, by half its edges. A null material is the usual one. */
CAIRN_C_EXPORT int cairnAddBox(CairnWorld* world, const float halfExtents[3], const CairnPose* pose,
                               const CairnMaterial* material);
/** Adds a body and returns its number, from 0 on; a number is used again after its body was removed. A mass of 0 makes
 * the body immovable; others are 1e-6 to 1e9 kg. A null material is the usual one. Negative where a value is out of
 * range. */
CAIRN_C_EXPORT int32_t cairnAddBody(CairnWorld* world, const CairnShape* shape, float mass, const CairnPose* pose,
                                    const CairnMaterial* material);
/** Removes a body. 0 where there is none of this number, as in all functions that take one. */
CAIRN_C_EXPORT int cairnRemoveBody(CairnWorld* world, int32_t body);
/** Puts a body elsewhere and wakes it; its velocities stay. */
CAIRN_C_EXPORT int cairnSetPose(CairnWorld* world, int32_t body, const CairnPose* pose);
/** Sets the velocities of a body's centre of mass, m/s and rad/s, and wakes it. */
CAIRN_C_EXPORT int cairnSetVelocity(CairnWorld* world, int32_t body, const float linear[3], const float angular[3]);
/** Pulls a body's `point` (mesh frame, m) to `target` (world) in every step, by at most 200 m/s^2, until it is
 * released. */
CAIRN_C_EXPORT int cairnDragBody(CairnWorld* world, int32_t body, const float point[3], const float target[3]);
/** Lets go of a body. */
CAIRN_C_EXPORT int cairnReleaseBody(CairnWorld* world, int32_t body);

/** Moves the world on by its time step. 0 where memory ran out; the world is then to be freed. */
CAIRN_C_EXPORT int cairnStep(CairnWorld* world);
/** What the last step did. */
CAIRN_C_EXPORT void cairnLastStep(const CairnWorld* world, CairnStatistics* statistics);

/** The numbers in use are below this. */
CAIRN_C_EXPORT int32_t cairnBodyCount(const CairnWorld* world);
/** Where a body's mesh is. */
CAIRN_C_EXPORT int cairnGetPose(const CairnWorld* world, int32_t body, CairnPose* pose);
/** The velocities of a body's centre of mass, m/s and rad/s. */
CAIRN_C_EXPORT int cairnGetVelocity(const CairnWorld* world, int32_t body, float linear[3], float angular[3]);
/** 1 where a body sleeps, 0 where it is awake, negative where there is none. */
CAIRN_C_EXPORT int cairnIsAsleep(const CairnWorld* world, int32_t body);
/** Writes the contacts of the last step to at most `room` places. Returns how many there are. `contacts` may be null
 * where `room` is 0. */
CAIRN_C_EXPORT size_t cairnContacts(const CairnWorld* world, CairnContact* contacts, size_t room);
/** Writes sixteen hexadecimal digits and a final zero: a hash of all places, rotations and velocities.
 * An empty string where memory ran out. */
CAIRN_C_EXPORT void cairnStateHash(const CairnWorld* world, char hash[17]);

#ifdef __cplusplus
}
#endif

#endif
