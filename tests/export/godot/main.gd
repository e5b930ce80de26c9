# SPDX-License-Identifier: MIT
# Loads what was exported for Godot as a user's project does, and hands pictures of it to the page.
extends Node3D

const SIZE := 96

var viewport: SubViewport

func _ready() -> void:
	await get_tree().process_frame
	for i in 9:
		await picture("ball %d" % i, "res://probe-%d/godot" % i, "ball")
	await picture("quad", "res://probe-0/godot", "quad")
	await picture("directional", "res://probe-0/godot-directional", "quad")
	JavaScriptBridge.eval("window.received('done', '')")

func picture(title: String, path: String, shown: String) -> void:
	var root := stage()
	var document := GLTFDocument.new()
	var state := GLTFState.new()
	if document.append_from_file(path + ".gltf", state) != OK:
		print("cannot read ", path, ".gltf")
		return
	var scene := document.generate_scene(state)
	root.add_child(scene)
	for mesh: MeshInstance3D in scene.find_children("*", "MeshInstance3D", true, false):
		mesh.visible = mesh.name == shown
		mesh.gi_mode = GeometryInstance3D.GI_MODE_DYNAMIC if mesh.name == "ball" else GeometryInstance3D.GI_MODE_STATIC
		for surface in mesh.mesh.get_surface_count():
			var material: BaseMaterial3D = mesh.mesh.surface_get_material(surface)
			material.metallic_specular = 0.0
	for camera: Camera3D in scene.find_children("*", "Camera3D", true, false):
		camera.current = false
	var light := LightmapGI.new()
	light.set_script(load(path + "-godot.gd"))
	light.source = load(path + ".tres")
	root.add_child(light)
	root.get_node("Camera").make_current()
	for k in 4:
		await RenderingServer.frame_post_draw
	var image := viewport.get_texture().get_image()
	image.convert(Image.FORMAT_RGBA8)
	JavaScriptBridge.eval("window.received('%s', '%s')" % [title, Marshalls.raw_to_base64(image.get_data())])
	viewport.queue_free()
	await get_tree().process_frame

## A world of its own, seen from +Z through a square of side 2, without light.
func stage() -> Node3D:
	viewport = SubViewport.new()
	viewport.size = Vector2i(SIZE, SIZE)
	viewport.own_world_3d = true
	viewport.render_target_update_mode = SubViewport.UPDATE_ALWAYS
	add_child(viewport)
	var root := Node3D.new()
	viewport.add_child(root)
	var camera := Camera3D.new()
	camera.name = "Camera"
	camera.projection = Camera3D.PROJECTION_ORTHOGONAL
	camera.size = 2.0
	camera.position = Vector3(0, 0, 5)
	root.add_child(camera)
	var environment := Environment.new()
	environment.background_mode = Environment.BG_COLOR
	environment.background_color = Color.BLACK
	environment.ambient_light_source = Environment.AMBIENT_SOURCE_DISABLED
	environment.reflected_light_source = Environment.REFLECTION_SOURCE_DISABLED
	environment.tonemap_mode = Environment.TONE_MAPPER_LINEAR
	var world := WorldEnvironment.new()
	world.environment = environment
	root.add_child(world)
	return root
