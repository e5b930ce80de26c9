/* SPDX-License-Identifier: MIT */
/* Relights a transport file of Limn (docs/transport-format.md): lamps, albedo, emission and sky may
   change in every frame, and bounced light follows. Needs the C++ standard library only. No
   function but limnrt_open() allocates; none reads files, starts threads or throws. One scene is
   used by one thread at a time. World space is right-handed with +Y up, in metres; colours are
   linear Rec. 709. Candela, lux and nits count as W/sr, W/m^2 and W/(sr m^2), without a factor of
   683. Spherical harmonics are real and orthonormal without the Condon-Shortley sign, coefficient
   (l, m) at l(l+1)+m, of incident radiance. Functions that return int return 1, or 0 where an
   argument is out of range or a number is not finite; then nothing has changed. */
#ifndef LIMN_RUNTIME_H
#define LIMN_RUNTIME_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct limnrt_scene limnrt_scene;

enum { LIMNRT_DIRECTIONAL = 0, LIMNRT_POINT = 1, LIMNRT_SPOT = 2, LIMNRT_RECTANGLE = 3 }; /* kind */
enum { LIMNRT_LIGHT_OFF = 1, LIMNRT_NO_SHADOWS = 2 }; /* flags of a light */
enum { LIMNRT_SKIP_HASHES = 1 }; /* flag of limnrt_options: the sections' hashes are not compared */
enum { LIMNRT_NO_CACHE = 0xffffffffu };

/* A light, 80 bytes, as in the file's section LGHT. */
typedef struct limnrt_light {
    uint32_t kind, flags;
    float position[3];   /* [m]; a rectangle's middle; ignored by DIRECTIONAL */
    float direction[3];  /* unit, the way light travels; ignored by POINT */
    float color[3];      /* [0, 1e10] */
    float strength;      /* DIRECTIONAL [lux]; POINT, SPOT [cd]; RECTANGLE [nits]; [0, 1e10] */
    float range;         /* [m]; POINT, SPOT; 0: unlimited */
    float inner_angle;   /* SPOT: half-angle of full strength [rad] */
    float outer_angle;   /* SPOT: half-angle where it ends [rad], (inner_angle, pi/2] */
    float width, height; /* RECTANGLE [m], [1e-6, 1e6] */
    float roll;          /* RECTANGLE: turn about `direction` [rad] */
    uint32_t source;     /* index in META's "lights"; parts of one rectangle share it; not used for
                            lighting */
    uint32_t reserved;   /* 0 */
} limnrt_light;

/* All fields may be 0. */
typedef struct limnrt_options {
    uint32_t bands;      /* SH bands of the results, [2, the file's]; 0: the file's */
    uint32_t max_lights; /* most lights of limnrt_set_lights(); 0: 16, or as many as the file has */
    uint32_t flags, max_kept; /* max_kept: slots of limn_kept_light.h, [0, 4096] */
    void* (*allocate)(size_t bytes, void* user); /* called once, by limnrt_open(); 0: malloc */
    void (*release)(void* block, void* user);    /* called once, by limnrt_close(); 0: free */
    void* user;
} limnrt_options;

typedef struct limnrt_counts {
    uint32_t surfels, sky_cells, nodes, caches, lightmap_caches, materials, lights, max_lights,
        triangles;
    uint32_t bands, chroma_bands; /* of the results; the bands from chroma_bands on are grey */
    uint32_t lightmap_width, lightmap_height, grid[3];
    float grid_lower[3], grid_upper[3]; /* centres: lower + (c + 0.5) / grid * (upper - lower) */
    uint64_t links, memory;             /* memory: bytes allocated by limnrt_open() */
} limnrt_counts;

/* Opens a file that lies uncompressed in memory. `bytes` is aligned to 16 bytes and outlives the
   scene, which reads it in place. Every count, offset and index is checked here. `options` may be
   0. On failure returns 0 and writes a message of at most error_size - 1 bytes to `error`, which
   may be 0. The scene starts with the file's lights, albedo, emission, sky and no bounced light. */
limnrt_scene* limnrt_open(const void* bytes, size_t size, const limnrt_options* options,
                          char* error, size_t error_size);
void limnrt_close(limnrt_scene*); /* 0 is allowed */

/* Pointers into the file's bytes. */
void limnrt_get_counts(const limnrt_scene*, limnrt_counts* counts);
const char* limnrt_meta(const limnrt_scene*, size_t* size); /* JSON, not terminated by 0 */
const char* limnrt_material_name(const limnrt_scene*, uint32_t index); /* UTF-8; 0 after the last */
const float* limnrt_surfel_positions(const limnrt_scene*);             /* 3 each */
const float* limnrt_surfel_normals(const limnrt_scene*);               /* 3 each, unit */
/* Points [m], 3 each, whose mean direct light is the surfel's; sets *each to its number of them. */
const float* limnrt_light_points(const limnrt_scene*, uint32_t* each);
const float* limnrt_light_normals(const limnrt_scene*); /* 3 each, unit; 0: the surfels' own */
const float* limnrt_surfel_areas(const limnrt_scene*);  /* [m^2] */
const uint32_t* limnrt_surfel_materials(const limnrt_scene*);
const uint32_t* limnrt_surfel_instances(const limnrt_scene*);
/* 3 each, lightmap caches, then the grid's cells, which have no normals; normals are unit. */
const float* limnrt_cache_positions(const limnrt_scene*);
const float* limnrt_cache_normals(const limnrt_scene*);
const float* limnrt_sky_directions(const limnrt_scene*); /* 3 each, unit, to the cell's middle */
const float* limnrt_file_sky(const limnrt_scene*);       /* 3 each [nits] */
const limnrt_light* limnrt_file_lights(const limnrt_scene*);

/* Lights, of which at most max_lights. Each one's shadows are kept as long as its place and shape
   stay: another colour or strength traces no ray, and a light that moved retraces itself alone. */
int limnrt_set_lights(limnrt_scene*, const limnrt_light* lights, uint32_t count);
/* The caller's own direct irradiance per surfel [W m^-2], 3 each, instead of lights, until the next
   limnrt_set_lights(). */
int limnrt_set_direct(limnrt_scene*, const float* rgb);
/* Direct irradiance per surfel that the lights bring, shadows included: red, green, blue, 0. */
const float* limnrt_direct(const limnrt_scene*);

/* Surfels [first, first + count), 3 each: albedo in [0, 0.99], radiance in [0, 1e10] nits. */
int limnrt_set_albedo(limnrt_scene*, uint32_t first, uint32_t count, const float* rgb);
int limnrt_set_emission(limnrt_scene*, uint32_t first, uint32_t count, const float* rgb);
/* All surfels of a material: one albedo or emission for each, or the file's values times a factor
   in [0, 1e10], which keeps what textures vary. Products are cut off at the ranges above. */
int limnrt_set_material_albedo(limnrt_scene*, uint32_t material, const float rgb[3]);
int limnrt_set_material_emission(limnrt_scene*, uint32_t material, const float rgb[3]);
int limnrt_scale_material_albedo(limnrt_scene*, uint32_t material, const float rgb[3]);
int limnrt_scale_material_emission(limnrt_scene*, uint32_t material, const float rgb[3]);
/* Radiance of all sky cells [nits] in [0, 1e10], 3 each. */
int limnrt_set_sky(limnrt_scene*, const float* rgb);

/* One bounce: surfels send what they receive, caches gather it, surfels read it. Returns the change
   of what is sent, relative to all of it, in [0, 1]. */
float limnrt_step(limnrt_scene*);
/* Share of all light that may still be missing when it has converged, [1e-7, 1]; at first 1e-4. */
int limnrt_set_tolerance(limnrt_scene*, float tolerance);
/* Bounces until light has converged, at most `max_bounces`; their number, 0 if nothing changed. */
uint32_t limnrt_converge(limnrt_scene*, uint32_t max_bounces);
int limnrt_converged(const limnrt_scene*); /* 1 where limnrt_converge() would do nothing */
float limnrt_missing(const limnrt_scene*); /* estimated share of all light, [0, 1] */
void limnrt_reset(limnrt_scene*); /* forgets bounced light: n steps then bring n bounces exactly */

/* Radiosity per node of the tree, surfels first: red, green, blue [W m^-2] and luma. */
const float* limnrt_radiosity(const limnrt_scene*);
/* Results, lit when they are asked for, where the light has changed. All are of bounced light and
   of what surfaces and sky emit, without the direct light of lamps. */
/* Per cache bands^2 coefficients of 4 floats: red, green, blue [W m^-2 sr^-1], 0. */
const float* limnrt_cache_sh(limnrt_scene*);
/* Writes the lightmap: layer i holds coefficient i, width * height texels of 4 floats, or halfs
   (IEEE 754 binary16, cut off at 65504, times `scale`), red, green, blue and 1 where a chart lies
   or 0 where none does. The upper row comes first. */
void limnrt_lightmap_sh(limnrt_scene*, float* rgba);
void limnrt_lightmap_sh_half(limnrt_scene*, float scale, uint16_t* rgba);
/* Writes the lightmap's irradiance [W m^-2], >= 0, in one layer of the same form, for `normals`
   (unit, 3 a texel) or, with 0, for the caches' own, which are the surface's. */
void limnrt_lightmap_irradiance(limnrt_scene*, const float* normals, float* rgba);
/* The same as halfs, times `scale`, as limnrt_lightmap_sh_half() writes them. */
void limnrt_lightmap_irradiance_half(limnrt_scene*, const float* normals, float scale, uint16_t*);
/* Writes the grid: layer i is coefficient i, cells (z * ny + y) * nx + x of 4 floats. */
void limnrt_grid_sh(limnrt_scene*, float* rgba);
/* Light of the grid at a point of a dynamic object: the eight cells around it, weighted by distance
   and by whether they see the point. `normal` is unit. Writes irradiance [W m^-2], 3 floats, or
   bands^2 coefficients of 4 floats. 0 where the file has no grid. */
int limnrt_sample_grid(limnrt_scene*, const float position[3], const float normal[3], float rgb[3]);
int limnrt_sample_grid_sh(limnrt_scene*, const float position[3], const float normal[3],
                          float* rgba);

#ifdef __cplusplus
}
#endif
#endif
