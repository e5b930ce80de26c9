# SPDX-License-Identifier: MIT
# blender -b -noaudio --python blender_scene.py -- STEM OUT.exr WHOLE.exr WIDTH HEIGHT [FROM]: shows an exported scene by its own script and
# renders, with Cycles, the whole picture with lamps and sky, and then the bounced light that surfaces reflect. FROM: JSON of eye, target
# and fov, in glTF's axes; else the file's first camera.
import importlib.util
import json
import math
import sys

import bpy
from mathutils import Vector

stem, out, whole, width, height, *rest = sys.argv[sys.argv.index('--') + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
spec = importlib.util.spec_from_file_location('exported', stem + '-blender.py')
exported = importlib.util.module_from_spec(spec)
spec.loader.exec_module(exported)
lit = exported.show(stem + '.gltf')
scene = bpy.context.scene
if rest:
    view = json.loads(rest[0])
    camera = bpy.data.objects.new('from', bpy.data.cameras.new('from'))
    scene.collection.objects.link(camera)
    x, y, z = view['eye']
    camera.location = (x, -z, y)
    x, y, z = view['target']
    camera.rotation_euler = (Vector((x, -z, y)) - camera.location).to_track_quat('-Z', 'Y').to_euler()
    angle = math.radians(view['fov'])
else:
    with open(stem + '.gltf', encoding='utf-8') as file:
        gltf = json.load(file)
    angle = gltf['cameras'][0]['perspective']['yfov']
    name = next(n['name'] for n in gltf['nodes'] if n.get('camera') == 0)
    camera = next(o for o in bpy.data.objects if o.type == 'CAMERA' and name in (o.name, o.parent and o.parent.name))
camera.data.sensor_fit = 'VERTICAL'
camera.data.angle = angle
camera.data.clip_start = 0.01
scene.camera = camera
scene.render.engine = 'CYCLES'
scene.cycles.use_denoising = False
scene.cycles.device = 'CPU'
scene.render.filter_size = 0.01
scene.render.resolution_x, scene.render.resolution_y = int(width), int(height)


def render(path, samples):
    scene.cycles.samples = samples
    scene.render.filepath = path
    scene.render.image_settings.file_format = 'OPEN_EXR'
    scene.render.image_settings.color_mode = 'RGB'
    scene.render.image_settings.color_depth = '32'
    bpy.ops.render.render(write_still=True)
    scene.render.image_settings.file_format = 'PNG'
    scene.render.image_settings.color_depth = '8'
    bpy.data.images['Render Result'].save_render(path[:-4] + '.png')


render(whole, 64)
scene.cycles.max_bounces = 0
scene.world.use_nodes = False
for thing in bpy.data.objects:
    if thing.type == 'LIGHT':
        thing.hide_render = True
for thing in lit:
    for slot in thing.material_slots:  # only the lightmap: neither the material's own emission nor lamps
        tree = slot.material.node_tree
        for node in tree.nodes:
            if node.type == 'ADD_SHADER':
                for link in list(node.inputs[1].links):
                    tree.links.remove(link)
render(out, 1)
