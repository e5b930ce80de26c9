# SPDX-License-Identifier: MIT
# Shows a scene that Limn exported in Blender, 3.4 or later:
#
#     blender --python ROOM-blender.py
#
# or in the text editor, beside the exported files. The camera sees albedo / pi times the irradiance that the lightmap holds, on top of
# what Blender's lamps do, and so do reflections. The lightmap has all bounces and the light of emissive surfaces and of the sky, so
# these light nothing here; the sky shows behind the scene. Lamps are left out if the lightmap includes their light.
import json
import math
import os
import urllib.parse

import bpy

try:  # the glTF importer of Blender 3.4 needs a name that NumPy 1.24 dropped
    import numpy
    numpy.bool = bool
except ImportError:
    pass


def times(tree, socket, factor):
    node = tree.nodes.new('ShaderNodeMath')
    node.operation = 'MULTIPLY'
    tree.links.new(socket, node.inputs[0])
    node.inputs[1].default_value = factor
    return node.outputs[0]


def connect(tree, source, target):
    """Gives the input `target` what the input `source` has."""
    if source.is_linked:
        tree.links.new(source.links[0].from_socket, target)
    else:
        target.default_value = source.default_value


def emission_of(material, image, uv_map):
    """A copy of the material that also sends albedo / pi * texel to the camera."""
    copy = material.copy()
    copy.use_nodes = True
    copy.cycles.sample_as_light = False
    tree = copy.node_tree
    output = next(n for n in tree.nodes if n.type == 'OUTPUT_MATERIAL')
    surface = next((n for n in tree.nodes if n.type == 'BSDF_PRINCIPLED'), None)

    uv = tree.nodes.new('ShaderNodeUVMap')
    uv.uv_map = uv_map
    texture = tree.nodes.new('ShaderNodeTexImage')
    texture.image = image
    texture.interpolation = 'Linear'
    texture.extension = 'EXTEND'
    tree.links.new(uv.outputs[0], texture.inputs[0])

    product = tree.nodes.new('ShaderNodeMixRGB')
    product.blend_type = 'MULTIPLY'
    product.inputs[0].default_value = 1
    tree.links.new(texture.outputs[0], product.inputs[1])
    product.inputs[2].default_value = (1, 1, 1, 1)
    if surface:
        connect(tree, surface.inputs['Base Color'], product.inputs[2])

    path = tree.nodes.new('ShaderNodeLightPath')
    seen = tree.nodes.new('ShaderNodeMath')  # 1 for rays of the camera and reflected ones
    seen.operation = 'MAXIMUM'
    tree.links.new(path.outputs['Is Camera Ray'], seen.inputs[0])
    tree.links.new(path.outputs['Is Glossy Ray'], seen.inputs[1])
    seen = seen.outputs[0]
    emission = tree.nodes.new('ShaderNodeEmission')
    strength = times(tree, seen, 1 / math.pi)
    if surface:  # metals have no diffuse albedo
        dielectric = tree.nodes.new('ShaderNodeMath')
        dielectric.operation = 'SUBTRACT'
        dielectric.inputs[0].default_value = 1
        connect(tree, surface.inputs['Metallic'], dielectric.inputs[1])
        product_of = tree.nodes.new('ShaderNodeMath')
        product_of.operation = 'MULTIPLY'
        tree.links.new(strength, product_of.inputs[0])
        tree.links.new(dielectric.outputs[0], product_of.inputs[1])
        strength = product_of.outputs[0]
    tree.links.new(strength, emission.inputs['Strength'])
    tree.links.new(product.outputs[0], emission.inputs[0])
    shown = emission.outputs[0]
    if surface:
        strength = surface.inputs['Emission Strength']
        if not strength.is_linked:  # seen by the camera and in mirrors alone, since what is rough would find it too seldom
            sharp = tree.nodes.new('ShaderNodeMath')
            sharp.operation = 'MAXIMUM'
            tree.links.new(path.outputs['Is Camera Ray'], sharp.inputs[0])
            tree.links.new(path.outputs['Is Singular Ray'], sharp.inputs[1])
            tree.links.new(times(tree, sharp.outputs[0], strength.default_value), strength)
        add = tree.nodes.new('ShaderNodeAddShader')
        tree.links.new(shown, add.inputs[0])
        tree.links.new(surface.outputs[0], add.inputs[1])
        shown = add.outputs[0]
    if material.use_backface_culling:  # Cycles shows backs: a two-sided sheet was exported as two surfaces in one place
        facing = tree.nodes.new('ShaderNodeMixShader')
        tree.links.new(tree.nodes.new('ShaderNodeNewGeometry').outputs['Backfacing'], facing.inputs[0])
        tree.links.new(shown, facing.inputs[1])
        tree.links.new(tree.nodes.new('ShaderNodeBsdfTransparent').outputs[0], facing.inputs[2])
        shown = facing.outputs[0]
    tree.links.new(shown, output.inputs[0])
    return copy


def part_sides(mesh):
    """Moves the two surfaces that a two-sided sheet was exported as apart, so that rays meet the right one first."""
    middles = {tuple(round(c, 5) for c in polygon.center) for polygon in mesh.polygons}
    if len(middles) == len(mesh.polygons):
        return
    corners = [v.co.copy() for v in mesh.vertices]
    size = max(max(c[a] for c in corners) - min(c[a] for c in corners) for a in range(3))
    normals = [v.normal.copy() for v in mesh.vertices]
    for vertex, normal in zip(mesh.vertices, normals):
        vertex.co += normal * (2e-4 * size)


def linear_image(path):
    image = bpy.data.images.load(path)
    names = [s.identifier for s in image.colorspace_settings.bl_rna.properties['name'].enum_items]
    image.colorspace_settings.name = 'Linear Rec.709' if 'Linear Rec.709' in names else 'Linear'
    return image


def set_strength(thing, lights):
    """Gives a lamp what glTF says: importers of Blender take photometric units for others. Lamps of one name are in the file's order."""
    name = thing.data.name
    while name not in lights and '.' in name:
        name = name.rpartition('.')[0]
    if not lights.get(name):
        return
    light = lights[name].pop(0)
    strength = light.get('intensity', 1)
    thing.data.energy = strength if light['type'] == 'directional' else 4 * math.pi * strength
    if light['type'] == 'directional':
        thing.data.angle = 0
    else:
        thing.data.shadow_soft_size = 0


def show_sky(scene, image):
    """A world that the camera and reflections see and that lights nothing. Without an image it is black."""
    if not scene.world:
        scene.world = bpy.data.worlds.new('Limn')
    world = scene.world
    world.color = (0, 0, 0)
    world.use_nodes = image is not None
    if not image:
        return
    tree = world.node_tree
    tree.nodes.clear()
    texture = tree.nodes.new('ShaderNodeTexEnvironment')
    texture.image = image
    background = tree.nodes.new('ShaderNodeBackground')
    tree.links.new(texture.outputs[0], background.inputs[0])
    tree.links.new(background.outputs[0], tree.nodes.new('ShaderNodeOutputWorld').inputs[0])
    world.cycles_visibility.diffuse = False
    world.cycles_visibility.scatter = False


def show(path):
    """Imports the glTF file and wires its lightmap; returns the objects that have one."""
    with open(path, encoding='utf-8') as file:
        gltf = json.load(file)
    limn = gltf['asset']['extras']['limn']
    beside = lambda uri: os.path.join(os.path.dirname(path), urllib.parse.unquote(uri))
    lights = {}
    for light in gltf.get('extensions', {}).get('KHR_lights_punctual', {}).get('lights', []):
        lights.setdefault(light.get('name', ''), []).append(light)
    before = set(bpy.data.objects)
    bpy.ops.import_scene.gltf(filepath=path)
    imported = [o for o in bpy.data.objects if o not in before]
    scene = bpy.context.scene
    show_sky(scene, linear_image(beside(limn['sky']['uri'])) if 'sky' in limn else None)
    lightmap = limn.get('lightmap')
    if not lightmap:
        return []
    images = [linear_image(beside(uri)) for uri in lightmap.get('uris') or [lightmap['uri']]]
    copies, lit, parted = {}, [], []
    for thing in imported:
        if thing.type == 'LIGHT' and lightmap['includesDirectLight']:
            bpy.data.objects.remove(thing)
            continue
        if thing.type == 'LIGHT':
            set_strength(thing, lights)
        if thing.type != 'MESH' or 'UVMap.001' not in thing.data.uv_layers:
            continue
        for slot in thing.material_slots:
            if slot.material not in copies:
                page = slot.material.get('limn', {}).get('lightmapPage', 0)
                copies[slot.material] = emission_of(slot.material, images[int(page)], 'UVMap.001')
            slot.material = copies[slot.material]
        if thing.data not in parted:
            part_sides(thing.data)
            parted.append(thing.data)
        lit.append(thing)
    scene.view_settings.view_transform = 'Standard'
    scene.cycles.max_bounces = scene.cycles.glossy_bounces = scene.cycles.transmission_bounces = 1
    scene.cycles.diffuse_bounces = 0  # the lightmap has these
    return lit


if __name__ == '__main__':
    here = os.path.abspath(__file__) if '__file__' in globals() else bpy.context.space_data.text.filepath
    show(here[:-len('-blender.py')] + '.gltf')
