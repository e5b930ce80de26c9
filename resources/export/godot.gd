# SPDX-License-Identifier: MIT
# Shows light that Limn exported for Godot 4. Import ROOM.gltf with "Meshes > Light Baking: Static" (not "Static Lightmaps", which
# would replace its second texture coordinates), add a LightmapGI node beside it, give it this script, and set "Source" to ROOM.tres.
# Objects without a lightmap are lit by the probes: set their "Global Illumination > Mode" to "Dynamic". Lamps get the strength that the
# glTF file gives them, and shadows. The sky is shown, and metal reflects the room, unless there is a
# WorldEnvironment. With the Compatibility renderer, metal is rough instead.
extends LightmapGI

## The LightmapGIData that was exported.
@export var source: LightmapGIData

func _ready() -> void:
	if source:
		show_light(source)
		if source.get_meta("direct", false):
			show_lamps(false)
		else:
			set_up_lamps()
		show_surroundings(source.get_meta("environment", null))
		if not RenderingServer.get_rendering_device(): # the Compatibility renderer
			dull_metal()

## Assigns the lightmap to every mesh below this node's parent that has a second set of texture coordinates.
func show_light(data: LightmapGIData) -> void:
	data.clear_users()
	_add_users(get_parent(), data)
	light_data = null
	light_data = data

## Gives the lamps their strength, once, and shadows, which backs cast, too, as light is blocked in Limn.
func set_up_lamps() -> void:
	var extent := _bounds().size.length()
	for mesh: MeshInstance3D in get_parent().find_children("*", "MeshInstance3D", true, false):
		mesh.cast_shadow = GeometryInstance3D.SHADOW_CASTING_SETTING_DOUBLE_SIDED
	for lamp: Light3D in get_parent().find_children("*", "Light3D", true, false):
		lamp.shadow_enabled = true
		lamp.light_energy /= PI # of glTF; Godot's lamps have the irradiance pi at an energy of 1
		if lamp is DirectionalLight3D:
			lamp.directional_shadow_max_distance = extent
			continue
		lamp.set_param(Light3D.PARAM_ATTENUATION, 2.0) # with the square of the distance
		lamp.set_param(Light3D.PARAM_RANGE, minf(lamp.get_param(Light3D.PARAM_RANGE), 2.0 * extent))

func show_lamps(shown: bool) -> void:
	for lamp: Light3D in get_parent().find_children("*", "Light3D", true, false):
		lamp.visible = shown

## The sky, and what metal reflects: the room as it is seen from a place in the open.
func show_surroundings(environment: Environment) -> void:
	if not environment or get_viewport().find_world_3d().environment:
		return
	var world := WorldEnvironment.new()
	world.environment = environment
	add_child(world)

## Lets metal send its colour of the lightmap's light, as a rough one does, where it would reflect nothing and be black.
func dull_metal() -> void:
	var dull := {}
	for node: MeshInstance3D in get_parent().find_children("*", "MeshInstance3D", true, false):
		for surface in node.mesh.get_surface_count():
			var material := node.mesh.surface_get_material(surface) as BaseMaterial3D
			if not material or material.metallic == 0.0 or dull.values().has(material):
				continue
			if not dull.has(material):
				dull[material] = material.duplicate()
				dull[material].metallic = 0.0
			node.mesh.surface_set_material(surface, dull[material])

func _bounds() -> AABB:
	var bounds := AABB()
	for mesh: MeshInstance3D in get_parent().find_children("*", "MeshInstance3D", true, false):
		var box := mesh.global_transform * mesh.get_aabb()
		bounds = bounds.merge(box) if bounds.has_volume() else box
	return bounds

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
