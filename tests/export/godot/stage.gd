# SPDX-License-Identifier: MIT
# A dark world that is drawn to a picture, which is handed to the page.
extends SubViewport

var environment := Environment.new()

func _init(width: int, height: int) -> void:
	size = Vector2i(width, height)
	own_world_3d = true
	render_target_update_mode = SubViewport.UPDATE_ALWAYS
	environment.background_mode = Environment.BG_COLOR
	environment.background_color = Color.BLACK
	environment.ambient_light_source = Environment.AMBIENT_SOURCE_DISABLED
	environment.reflected_light_source = Environment.REFLECTION_SOURCE_DISABLED
	environment.tonemap_mode = Environment.TONE_MAPPER_LINEAR
	var world := WorldEnvironment.new()
	world.environment = environment
	add_child(world)

## Draws `frames` frames, so that all is loaded, and hands over the last one as 8-bit RGBA.
func hand_over(title: String, frames: int) -> void:
	for k in frames:
		await RenderingServer.frame_post_draw
	var image := get_texture().get_image()
	image.convert(Image.FORMAT_RGBA8)
	JavaScriptBridge.eval("window.received('%s', '%s')" % [title, Marshalls.raw_to_base64(image.get_data())])
