#ifndef GNOMON_H
#define GNOMON_H

/* Gnomon for C and for languages that call C: exact truth of points, and of another renderer's mask (docs/c.md).
 * Nothing here needs GL.
 *
 * Functions that can fail return a status; gnomon_last_error() then returns one line with the problem, its place and
 * a remedy. The caller owns all arrays. Row 0 of an image is its top. Lengths are in the scene's unit. Any number of
 * threads may use a scene. */

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum gnomon_status {
    GNOMON_OK = 0,
    GNOMON_BAD_INPUT = 2,   /* an argument, or a file that it names, is invalid */
    GNOMON_ENVIRONMENT = 4, /* Embree, memory or a file failed */
    GNOMON_INTERNAL = 70    /* a bug in Gnomon */
} gnomon_status;

/* "0.1.0" */
const char *gnomon_version(void);

/* The message of this thread's last failed call; never null. */
const char *gnomon_last_error(void);

/* ---- scenes ---- */

typedef struct gnomon_scene gnomon_scene;

/* Makes a scene of triangles in memory. Rounds corners to float32 once and drops triangles without an area.
 * vertices: x, y, z of each, finite and within 1e15 of 0. triangles: three vertex indices each, counter-clockwise
 * seen from outside. */
gnomon_status gnomon_scene_from_arrays(const double *vertices, size_t vertex_count, const uint32_t *triangles,
                                       size_t triangle_count, gnomon_scene **scene);

/* Loads a scene file (.glb, .gltf, .obj, .ply, .stl, ...), or the scene of a job file (.toml). */
gnomon_status gnomon_scene_load(const char *path, gnomon_scene **scene);

/* Null is allowed. */
void gnomon_scene_free(gnomon_scene *scene);

size_t gnomon_scene_triangle_count(const gnomon_scene *scene);

/* The caller's index of each of the gnomon_scene_triangle_count() triangles; null for a loaded scene. */
const uint32_t *gnomon_scene_kept_triangles(const gnomon_scene *scene);

/* ---- lights ---- */

typedef enum gnomon_light_kind {
    GNOMON_DIRECTIONAL = 0, /* by direction, in which the light travels */
    GNOMON_POINT = 1,       /* by position */
    GNOMON_SPOT = 2         /* by position, target and cone_deg, the full opening angle */
} gnomon_light_kind;

typedef struct gnomon_light {
    int kind; /* gnomon_light_kind */
    double direction[3];
    double position[3];
    double target[3];
    double cone_deg;
    int keeps_doubles; /* 0: numbers are rounded to float32 once, as in a job; gnomon_evaluate() needs 0 */
} gnomon_light;

/* ---- points ---- */

typedef enum gnomon_class {
    GNOMON_BACKGROUND = 0,    /* pixels only: no surface */
    GNOMON_UNMATCHED = 1,     /* pixels only */
    GNOMON_ATTACHED = 2,      /* the triangle faces away from the light, or is edge-on */
    GNOMON_OUT_OF_LIGHT = 3,  /* outside a spot's cone */
    GNOMON_INDETERMINATE = 4, /* the segment to the light only touches an edge or a corner, or runs in a plane */
    GNOMON_LIT = 5,
    GNOMON_BLOCKED = 6
} gnomon_class;

#define GNOMON_NO_TRIANGLE UINT32_MAX

/* Output arrays with an element for each point; null for those not needed. */
typedef struct gnomon_truth {
    uint8_t *classes;   /* gnomon_class */
    uint32_t *witness;  /* a triangle that blocks the light, or GNOMON_NO_TRIANGLE */
    float *share;       /* two for each point: the interval of the visible share of the light */
} gnomon_truth;

/* Decides points in space, taken as exactly their three doubles: no triangle is a point's own.
 * threads: 0 for all cores. */
gnomon_status gnomon_truth_in_space(const gnomon_scene *scene, const gnomon_light *light, const double *points,
                                    size_t count, int threads, gnomon_truth truth);

typedef enum gnomon_side { GNOMON_TO_LIGHT = 0, GNOMON_FRONT = 1, GNOMON_BACK = 2 } gnomon_side;

/* Decides points on triangles of the scene, exactly a + u(b - a) + v(c - a): their own triangle never blocks them.
 * barycentrics: u, v of each. side: a gnomon_side, the side of the triangles that the points lie on. */
gnomon_status gnomon_truth_on_triangles(const gnomon_scene *scene, const gnomon_light *light, const uint32_t *triangles,
                                        const double *barycentrics, size_t count, int side, int threads,
                                        gnomon_truth truth);

/* ---- masks ---- */

/* Another renderer's shadow mask. Members that are 0 or null are not given. */
typedef struct gnomon_mask {
    int width, height;      /* [px] */
    const float *values;    /* 1 lit, 0 shadowed, between for filtered lookups */
    const float *positions; /* x, y, z that each pixel shows; NaN for pixels that are not scored */
    const float *normals;   /* x, y, z of the geometric normal on the visible side; may be null */
    const double *eye;      /* x, y, z of a perspective camera; null if unknown */
    int has_fractions;      /* whether fractions are intended; else they count as a mistake */
    double tolerance;       /* the largest distance from the mesh of 99 % of the positions; 0 for the default */
} gnomon_mask;

typedef struct gnomon_evaluation gnomon_evaluation;

/* Compares the mask with the truth. A mask with a recognised mistake is GNOMON_BAD_INPUT; the message names it. */
gnomon_status gnomon_evaluate(const gnomon_scene *scene, const gnomon_light *light, const gnomon_mask *mask,
                              int threads, gnomon_evaluation **evaluation);

/* The output of `gnomon evaluate --json`; valid as long as the evaluation. */
const char *gnomon_evaluation_json(const gnomon_evaluation *evaluation);

/* A gnomon_class for each pixel. */
const uint8_t *gnomon_evaluation_classes(const gnomon_evaluation *evaluation);

/* Null is allowed. */
void gnomon_evaluation_free(gnomon_evaluation *evaluation);

#ifdef __cplusplus
}
#endif

#endif
