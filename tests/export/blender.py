# SPDX-License-Identifier: MIT
# blender -b -noaudio --python blender.py -- KNOWN: runs the exported script on the quad in known light, renders it with Cycles and
# prints a row of the table of run.mjs.
import importlib.util
import math
import os
import sys

import bpy

SIZE = 64
folder = os.path.join(sys.argv[sys.argv.index('--') + 1], 'probe-0')
bpy.ops.wm.read_factory_settings(use_empty=True)
spec = importlib.util.spec_from_file_location('exported', os.path.join(folder, 'blender-blender.py'))
exported = importlib.util.module_from_spec(spec)
spec.loader.exec_module(exported)
lit = exported.show(os.path.join(folder, 'blender.gltf'))
for thing in bpy.data.objects:
    thing.hide_render = thing.type == 'MESH' and thing not in lit

scene = bpy.context.scene
scene.render.engine = 'CYCLES'
scene.cycles.samples = 1
scene.cycles.use_denoising = False
scene.cycles.device = 'CPU'
scene.render.filter_size = 0.01
scene.render.resolution_x = scene.render.resolution_y = SIZE
camera = bpy.data.cameras.new('front')
camera.type = 'ORTHO'
camera.ortho_scale = 2
scene.camera = bpy.data.objects.new('front', camera)
scene.collection.objects.link(scene.camera)
scene.camera.location = (0, -5, 0)  # glTF's +Z is Blender's -Y
scene.camera.rotation_euler = (math.pi / 2, 0, 0)
scene.render.image_settings.file_format = 'OPEN_EXR'
scene.render.image_settings.color_depth = '32'
scene.render.filepath = os.path.join(os.path.dirname(folder), '..', 'blender.exr')
bpy.ops.render.render(write_still=True)
image = bpy.data.images.load(scene.render.filepath)
pixels = list(image.pixels)

error, ratio, count = 0.0, 0.0, 0
for row in range(2, SIZE - 2):
    for column in range(2, SIZE - 2):
        s, t = (column + 0.5) / SIZE, 1 - (row + 0.5) / SIZE
        expected = [0.5 * e / math.pi for e in (0.25 + 7 * s / 8, 3 * 7 * t / 8, 5)]
        found = pixels[4 * (row * SIZE + column):][:3]
        ratio += found[2] / expected[2]
        count += 1
        error = max(error, max(abs(a - b) for a, b in zip(found, expected)) / expected[2])
ok = len(lit) == 1 and error < 0.01
print(f'| Blender {bpy.app.version_string}, Cycles | lightmap as emission | {ratio / count:.3f} | {error:.3f} |{"" if ok else " FAILED"}')
sys.exit(0 if ok else 1)
