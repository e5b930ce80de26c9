# SPDX-License-Identifier: MIT
# Shows light that Limn exported for Godot 4. Import ROOM.gltf with "Meshes > Light Baking: Static" (not "Static Lightmaps", which
# would replace its second texture coordinates), add a LightmapGI node beside it, give it this script, and set "Source" to ROOM.tres.
# Objects without a lightmap are lit by the probes: set their "Global Illumination > Mode" to "Dynamic".
extends LightmapGI

## The LightmapGIData that was exported.
@export var source: LightmapGIData

func _ready() -> void:
	if source:
		show_light(source)

## Assigns the lightmap to every mesh below this node's parent that has a second set of texture coordinates.
func show_light(data: LightmapGIData) -> void:
	data.clear_users()
	_add_users(get_parent(), data)
	light_data = null
	light_data = data

func _add_users(node: Node, data: LightmapGIData) -> void:
	if node is MeshInstance3D and _has_uv2(node.mesh):
		data.add_user(get_path_to(node), Rect2(0, 0, 1, 1), 0, -1)
	for child in node.get_children():
		_add_users(child, data)

func _has_uv2(mesh: Mesh) -> bool:
	if not mesh or mesh.get_surface_count() == 0:
		return false
	for surface in mesh.get_surface_count():
		if mesh.surface_get_arrays(surface)[Mesh.ARRAY_TEX_UV2] == null:
			return false
	return true
