#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""relight.py liblimn_runtime.so SCENE.limnrt [BOUNCES]: lifts the first light by 10 cm, lets it bounce, 100 times at most, and prints the
mean irradiance, and what may be missing where that was too few."""
import ctypes as c
import sys

Light = type("Light", (c.Structure,), {"_fields_": [("kind", c.c_uint32), ("flags", c.c_uint32), ("position", c.c_float * 3), (
    "direction", c.c_float * 3), ("color", c.c_float * 3), ("numbers", c.c_float * 7), ("source", c.c_uint32), ("reserved", c.c_uint32)]})
COUNTS = "surfels sky_cells nodes caches lightmap_caches materials lights max_lights triangles bands chroma_bands width height".split()
Counts = type("Counts", (c.Structure,), {"_fields_": [(name, c.c_uint32) for name in COUNTS] + [
    ("grid", c.c_uint32 * 3), ("grid_bounds", c.c_float * 6), ("links", c.c_uint64), ("memory", c.c_uint64)]})
runtime, data = c.CDLL(sys.argv[1]), open(sys.argv[2], "rb").read()
runtime.limnrt_missing.restype = c.c_float
runtime.limnrt_open.restype = runtime.limnrt_file_lights.restype = c.c_void_p
buffer = c.create_string_buffer(len(data) + 64)
start = -c.addressof(buffer) % 64  # the bytes are read where they lie, aligned
buffer[start:start + len(data)] = data
error = c.create_string_buffer(256)
scene = c.c_void_p(runtime.limnrt_open(c.byref(buffer, start), c.c_size_t(len(data)), None, error, c.c_size_t(256)))
if not scene:
    sys.exit(error.value.decode())
counts = Counts()
runtime.limnrt_get_counts(scene, c.byref(counts))
if counts.lights:
    light = Light.from_buffer_copy((c.c_char * 80).from_address(runtime.limnrt_file_lights(scene)))
    light.position[1] += 0.1
    runtime.limnrt_set_lights(scene, c.byref(light), 1)
bounces, rgba = runtime.limnrt_converge(scene, int((sys.argv + [100])[3])), (c.c_float * (4 * counts.width * counts.height))()
runtime.limnrt_lightmap_irradiance(scene, None, rgba)
print(f"{bounces} bounces, mean irradiance {sum(rgba[1::4]) / max(sum(rgba[3::4]), 1):.6g} W/m^2")
if (missing := runtime.limnrt_missing(scene)) > 1e-4:  # the tolerance, unless limnrt_set_tolerance() has set another
    print(f"ended early: {100 * missing:.2g} % of the light may be missing")
