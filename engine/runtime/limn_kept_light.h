/* SPDX-License-Identifier: MIT */
/* Light that is kept and mixed. Bounced light is linear in what lamps, sky and emissive materials
   send: what each of them brings alone adds up. A program lights a scene of limn_runtime.h by one
   of them, or by a group that only changes together, keeps that light, and mixes it with others
   later at the cost of reading it, without a bounce. */
#ifndef LIMN_KEPT_LIGHT_H
#define LIMN_KEPT_LIGHT_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct limnrt_scene limnrt_scene;

/* Both return 1, or 0 where an argument is out of range; then nothing has changed. */

/* Keeps the results' present light in a slot below limnrt_options.max_kept, with 16 bits a number
   and a factor for each cache. Albedo and places that change afterwards do not change it. */
int limnrt_keep(limnrt_scene*, uint32_t slot);
/* Until the next bounce, all results are the sum of what slots 0 to count - 1 keep, each times its
   factor, `rgb`, 3 each in [0, 1e10]; grey bands times its luma. Slots with factor 0 may be empty.
   With count 0, results are those of the scene's own light again. */
int limnrt_mix(limnrt_scene*, const float* rgb, uint32_t count);

#ifdef __cplusplus
}
#endif
#endif
