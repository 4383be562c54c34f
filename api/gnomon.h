#ifndef GNOMON_H
#define GNOMON_H

/* Gnomon for C, and for languages that call C: what is true of points, and of another renderer's mask, decided
 * exactly (docs/c.md). Nothing here needs GL.
 *
 * Functions that can fail return a status; gnomon_last_error() then has one line that says what is wrong, where, and
 * what to do. Arrays belong to the caller, row 0 of an image is its top, lengths are in the scene's unit. Any number
 * of threads may use one scene. */

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum gnomon_status {
    GNOMON_OK = 0,
    GNOMON_BAD_INPUT = 2,   /* an argument, or what it says */
    GNOMON_ENVIRONMENT = 4, /* Embree, memory or a file failed */
    GNOMON_INTERNAL = 70    /* a defect of Gnomon */
} gnomon_status;

/* "0.1.0" */
const char *gnomon_version(void);

/* Of this thread's last call that failed; never null. */
const char *gnomon_last_error(void);

/* ---- scenes ---- */

typedef struct gnomon_scene gnomon_scene;

/* Triangles in memory. Corners are rounded to float32 once; triangles without an area are left out.
 * vertices: x, y, z of each, finite and within 1e15 of 0. triangles: three indices of vertices each, counter-clockwise
 * seen from outside. */
gnomon_status gnomon_scene_from_arrays(const double *vertices, size_t vertex_count, const uint32_t *triangles,
                                       size_t triangle_count, gnomon_scene **scene);

/* A scene file (.glb, .gltf, .obj, .ply, .stl, ...), or the scene of a job file (.toml). */
gnomon_status gnomon_scene_load(const char *path, gnomon_scene **scene);

/* Null is allowed. */
void gnomon_scene_free(gnomon_scene *scene);

size_t gnomon_scene_triangle_count(const gnomon_scene *scene);

/* Which of the caller's triangles each one is, gnomon_scene_triangle_count() of them; null of a scene that was loaded. */
const uint32_t *gnomon_scene_kept_triangles(const gnomon_scene *scene);

/* ---- lights ---- */

typedef enum gnomon_light_kind {
    GNOMON_DIRECTIONAL = 0, /* by direction, the way that the light travels */
    GNOMON_POINT = 1,       /* by position */
    GNOMON_SPOT = 2         /* by position, target and cone_deg, the full opening angle */
} gnomon_light_kind;

typedef struct gnomon_light {
    int kind; /* gnomon_light_kind */
    double direction[3];
    double position[3];
    double target[3];
    double cone_deg;
    int keeps_doubles; /* 0: the numbers are rounded to float32 once, as a job's are; gnomon_evaluate() needs 0 */
} gnomon_light;

/* ---- points ---- */

typedef enum gnomon_class {
    GNOMON_BACKGROUND = 0,    /* of pixels: nothing is there */
    GNOMON_UNMATCHED = 1,     /* of pixels */
    GNOMON_ATTACHED = 2,      /* the triangle is turned from the light, or edge-on */
    GNOMON_OUT_OF_LIGHT = 3,  /* outside a spot's cone */
    GNOMON_INDETERMINATE = 4, /* the segment to the light only touches an edge or a corner, or runs in a plane */
    GNOMON_LIT = 5,
    GNOMON_BLOCKED = 6
} gnomon_class;

#define GNOMON_NO_TRIANGLE UINT32_MAX

/* Where the answers go: an element for each point. Null: not asked for. */
typedef struct gnomon_truth {
    uint8_t *classes;   /* gnomon_class */
    uint32_t *witness;  /* a triangle that blocks the light, or GNOMON_NO_TRIANGLE */
    float *share;       /* two for each point: the interval of the share of the light that is seen */
} gnomon_truth;

/* Points in space, taken as their three doubles are: no triangle is a point's own.
 * threads: 0 for all cores. */
gnomon_status gnomon_truth_in_space(const gnomon_scene *scene, const gnomon_light *light, const double *points,
                                    size_t count, int threads, gnomon_truth truth);

typedef enum gnomon_side { GNOMON_TO_LIGHT = 0, GNOMON_FRONT = 1, GNOMON_BACK = 2 } gnomon_side;

/* Points on triangles of the scene, exactly a + u(b - a) + v(c - a): their own triangle never blocks them.
 * barycentrics: u, v of each. side: a gnomon_side, the one that they are on. */
gnomon_status gnomon_truth_on_triangles(const gnomon_scene *scene, const gnomon_light *light, const uint32_t *triangles,
                                        const double *barycentrics, size_t count, int side, int threads,
                                        gnomon_truth truth);

/* ---- masks ---- */

/* Another renderer's shadow mask. Zeroed members are not given. */
typedef struct gnomon_mask {
    int width, height;      /* [px] */
    const float *values;    /* 1 lit, 0 shadowed, between for filtered lookups */
    const float *positions; /* x, y, z that each pixel shows; NaN where nothing is to be judged */
    const float *normals;   /* x, y, z of the geometric normal on the side that is seen; null: none */
    const double *eye;      /* x, y, z of a perspective camera; null: not known */
    int has_fractions;      /* fractions are meant, and no sign of another image */
    double tolerance;       /* how far positions may be from the mesh, at 99 % of them; 0: the usual */
} gnomon_mask;

typedef struct gnomon_evaluation gnomon_evaluation;

/* Holds the mask to the truth. A mask that looks like a mistake is GNOMON_BAD_INPUT, which the line names. */
gnomon_status gnomon_evaluate(const gnomon_scene *scene, const gnomon_light *light, const gnomon_mask *mask,
                              int threads, gnomon_evaluation **evaluation);

/* What `gnomon evaluate --json` prints; it lives as long as the evaluation. */
const char *gnomon_evaluation_json(const gnomon_evaluation *evaluation);

/* A gnomon_class for each pixel. */
const uint8_t *gnomon_evaluation_classes(const gnomon_evaluation *evaluation);

/* Null is allowed. */
void gnomon_evaluation_free(gnomon_evaluation *evaluation);

#ifdef __cplusplus
}
#endif

#endif
