extends Node
# Draws with each shader of the page, and hands the pictures back to it.

var side: int

func _ready() -> void:
	var count: int = JavaScriptBridge.eval("jobs.length")
	for k in count:
		JavaScriptBridge.eval("current = %d" % k)
		side = JavaScriptBridge.eval("sides[%d]" % k)
		await judge(k, str(JavaScriptBridge.eval("jobs[%d]" % k)))
	JavaScriptBridge.eval("finished()")

func judge(k: int, code: String) -> void:
	var shader := Shader.new()
	shader.code = code
	var material := ShaderMaterial.new()
	material.shader = shader
	var view := SubViewport.new()
	view.size = Vector2i(side, side)
	view.own_world_3d = true
	view.render_target_update_mode = SubViewport.UPDATE_ALWAYS
	add_child(view)
	if shader.get_mode() == Shader.MODE_CANVAS_ITEM:
		fill(view, material)
	else:
		stage(view, material)
	for frame in 2:
		await RenderingServer.frame_post_draw
	var image := view.get_texture().get_image()
	image.convert(Image.FORMAT_RGB8)
	JavaScriptBridge.eval("pictures[%d] = '%s'" % [k, image.get_data().hex_encode()])
	view.queue_free()

func fill(view: SubViewport, material: ShaderMaterial) -> void:
	var rect := ColorRect.new()
	rect.size = Vector2(side, side)
	rect.material = material
	material.set_shader_parameter("pixels", Vector2(side, side))
	view.add_child(rect)

# The box in front of the camera, with a wall through its middle on the left.
func stage(view: SubViewport, material: ShaderMaterial) -> void:
	var box := MeshInstance3D.new()
	box.mesh = BoxMesh.new()
	var half: Variant = RenderingServer.shader_get_parameter_default(material.shader.get_rid(), "half_size")
	box.mesh.size = 2.0 * half if half is Vector3 else Vector3(2, 2, 2)
	box.material_override = material
	view.add_child(box)
	var wall := MeshInstance3D.new()
	wall.mesh = QuadMesh.new()
	wall.mesh.size = Vector2(8, 8)
	wall.position = Vector3(-4, 0, 0)
	var black := StandardMaterial3D.new()
	black.shading_mode = BaseMaterial3D.SHADING_MODE_UNSHADED
	black.albedo_color = Color.BLACK
	wall.material_override = black
	view.add_child(wall)
	var camera := Camera3D.new()
	camera.position = Vector3(0, 0, 4)
	view.add_child(camera)
	camera.current = true
	var world := WorldEnvironment.new()
	world.environment = Environment.new()
	world.environment.background_mode = Environment.BG_COLOR
	world.environment.background_color = Color.BLACK
	view.add_child(world)
