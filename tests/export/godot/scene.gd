# SPDX-License-Identifier: MIT
# Loads a whole exported scene and hands over pictures of its bounced light: first on white surfaces, exposed by each of
# scene.json's numbers, then of the whole scene with its lamps and sky.
extends Node3D

# White, with the holes of the material that it stands for, and without its normal map, as `limn render` shows irradiance.
const HOLES := "shader_type spatial;
render_mode %s;
uniform sampler2D color_map : source_color, filter_linear_mipmap, repeat_enable;
uniform float alpha, threshold;
void fragment() {
	if (texture(color_map, UV).a * alpha < threshold) discard;
	ALBEDO = vec3(1.0);
}"

const Stage := preload("res://stage.gd")

var viewport: Stage

func _ready() -> void:
	await get_tree().process_frame
	var wanted: Dictionary = JSON.parse_string(FileAccess.get_file_as_string("res://scene.json"))
	viewport = Stage.new(wanted.width, wanted.height)
	add_child(viewport)

	var document := GLTFDocument.new()
	var state := GLTFState.new()
	if document.append_from_file("res://godot.gltf", state) != OK:
		JavaScriptBridge.eval("window.received('failed', 'godot.gltf')")
		return
	var room := document.generate_scene(state)
	viewport.add_child(room)
	look(room, wanted.get("from"))
	var light := LightmapGI.new()
	light.set_script(load("res://godot-godot.gd"))
	light.source = load("res://godot.tres")
	viewport.add_child(light)
	light.show_lamps(false)

	var meshes := room.find_children("*", "MeshInstance3D", true, false)
	for mesh: MeshInstance3D in meshes:
		var lit: bool = mesh.mesh.surface_get_format(0) & Mesh.ARRAY_FORMAT_TEX_UV2
		mesh.gi_mode = GeometryInstance3D.GI_MODE_STATIC if lit else GeometryInstance3D.GI_MODE_DYNAMIC
		for surface in mesh.mesh.get_surface_count():
			mesh.set_surface_override_material(surface, white(mesh.mesh.surface_get_material(surface)))
	for exposure: float in wanted.exposures:
		await picture("white %s" % exposure, exposure)
	for mesh: MeshInstance3D in meshes:
		for surface in mesh.mesh.get_surface_count():
			mesh.set_surface_override_material(surface, null)
	light.show_lamps(true)
	var shown: Environment = light.source.get_meta("environment")
	viewport.environment.background_mode = shown.background_mode
	viewport.environment.sky = shown.sky
	viewport.environment.reflected_light_source = shown.reflected_light_source
	for exposure: float in wanted.exposures:
		await picture("whole %s" % exposure, exposure)
	await picture("scene", 1.0)
	JavaScriptBridge.eval("window.received('done', '')")

## The scene's first camera, or one of its own.
func look(room: Node, from: Variant) -> void:
	var camera: Camera3D
	if from:
		camera = Camera3D.new()
		viewport.add_child(camera)
		var eye := Vector3(from.eye[0], from.eye[1], from.eye[2])
		camera.look_at_from_position(eye, Vector3(from.target[0], from.target[1], from.target[2]))
		camera.fov = from.fov
		camera.near = 0.1
		camera.far = 1000.0
	else:
		camera = room.find_children("*", "Camera3D", true, false)[0]
	camera.keep_aspect = Camera3D.KEEP_HEIGHT
	camera.make_current()

func white(material: BaseMaterial3D) -> Material:
	if material.transparency != BaseMaterial3D.TRANSPARENCY_ALPHA_SCISSOR:
		var plain := StandardMaterial3D.new()
		plain.metallic_specular = 0.0
		plain.cull_mode = material.cull_mode
		return plain
	var holes := ShaderMaterial.new()
	holes.shader = Shader.new()
	holes.shader.code = HOLES % ("cull_disabled" if material.cull_mode == BaseMaterial3D.CULL_DISABLED else "cull_back")
	holes.set_shader_parameter("threshold", material.alpha_scissor_threshold)
	holes.set_shader_parameter("alpha", material.albedo_color.a)
	holes.set_shader_parameter("color_map", material.albedo_texture)
	return holes

func picture(title: String, exposure: float) -> void:
	viewport.environment.tonemap_exposure = exposure
	await viewport.hand_over(title, 3)
