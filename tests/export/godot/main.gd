# SPDX-License-Identifier: MIT
# Loads what was exported for Godot as a user's project does, and hands pictures of it to the page.
extends Node3D

const SIZE := 96
const Stage := preload("res://stage.gd")

func _ready() -> void:
	await get_tree().process_frame
	for i in 9:
		await picture("ball %d" % i, "res://probe-%d/godot" % i, "ball")
	await picture("quad", "res://probe-0/godot", "quad")
	await picture("directional", "res://probe-0/godot-directional", "quad")
	JavaScriptBridge.eval("window.received('done', '')")

func picture(title: String, path: String, shown: String) -> void:
	var viewport := stage()
	var document := GLTFDocument.new()
	var state := GLTFState.new()
	if document.append_from_file(path + ".gltf", state) != OK:
		print("cannot read ", path, ".gltf")
		return
	var scene := document.generate_scene(state)
	viewport.add_child(scene)
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
	viewport.add_child(light)
	viewport.get_node("Camera").make_current()
	await viewport.hand_over(title, 4)
	viewport.queue_free()
	await get_tree().process_frame

## A world seen from +Z through a square of side 2.
func stage() -> Stage:
	var viewport := Stage.new(SIZE, SIZE)
	add_child(viewport)
	var camera := Camera3D.new()
	camera.name = "Camera"
	camera.projection = Camera3D.PROJECTION_ORTHOGONAL
	camera.size = 2.0
	camera.position = Vector3(0, 0, 5)
	viewport.add_child(camera)
	return viewport
