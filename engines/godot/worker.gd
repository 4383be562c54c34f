# Inside Godot: builds the scene that it is told, and draws frames of it. One JSON object a line, over a socket of this machine.
extends SceneTree

const PLUS = 1
const MINUS = 2
const DIGITS = 4
const PASSES = """shader_type spatial;
render_mode unshaded, %s;
uniform float scale;
uniform int digit;
varying vec3 world;
void vertex() { world = (WORLD_MATRIX * vec4(VERTEX, 1.0)).xyz; }
void fragment() {
	vec3 rest = abs(world) / scale;
	vec3 shown = mix(vec3(%d.0), vec3(%d.0), step(vec3(0.0), world));
	for (int i = 0; i < digit; i++) {
		rest *= 256.0;
		shown = floor(rest);
		rest -= shown;
	}
	ALBEDO = shown / 255.0;
}
"""
const LIGHT = """shader_type spatial;
render_mode ambient_light_disabled, specular_disabled, %s;
void fragment() { ALBEDO = vec3(1.0); }
void light() { DIFFUSE_LIGHT += ATTENUATION; }
"""

const CULLS = {"cull_back": SpatialMaterial.CULL_BACK, "cull_front": SpatialMaterial.CULL_FRONT, "cull_disabled": SpatialMaterial.CULL_DISABLED}

var whites = {}
var idles = 0
var peer = StreamPeerTCP.new()
var viewport
var light
var meshes = []
var scene

func _initialize():
	var words = OS.get_cmdline_args()
	for cull in CULLS:
		whites[cull] = white(CULLS[cull])
	peer.connect_to_host("127.0.0.1", int(words[words.size() - 1]))

func _idle(_delta):
	idles += 1
	if idles < 3: # the main loop writes the shaders of Godot's own materials, and goes round no more below
		return
	while peer.get_status() == StreamPeerTCP.STATUS_CONNECTING:
		OS.delay_msec(2)
	while peer.get_status() == StreamPeerTCP.STATUS_CONNECTED:
		if peer.get_available_bytes() > 0:
			answer(parse_json(peer.get_string(peer.get_32())))
		else:
			OS.delay_msec(2)
	quit()

func answer(told):
	var said = {"device": VisualServer.get_video_adapter_name(), "version": Engine.get_version_info()["string"]}
	if told["call"] == "open":
		open(told)
	elif told["call"] == "draw":
		draw(told)
	var bytes = to_json(said).to_utf8()
	peer.put_32(bytes.size())
	peer.put_data(bytes)

func vector(numbers):
	return Vector3(numbers[0], numbers[1], numbers[2])

func looking(forward, up, position):
	return Transform(Basis(), position).looking_at(position + forward, up)

func vectors(file, count):
	var read = PoolVector3Array()
	read.resize(count)
	for i in range(count):
		read[i] = Vector3(file.get_float(), file.get_float(), file.get_float())
	return read

func mesh_of(path, count):
	var file = File.new()
	file.open(path, File.READ)
	var arrays = []
	arrays.resize(Mesh.ARRAY_MAX)
	arrays[Mesh.ARRAY_VERTEX] = vectors(file, count)
	arrays[Mesh.ARRAY_NORMAL] = vectors(file, count)
	file.close()
	var mesh = ArrayMesh.new()
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays, [], 0)
	return mesh

func open(told):
	if viewport:
		viewport.free()
	scene = told
	meshes = []
	viewport = Viewport.new()
	viewport.own_world = true
	viewport.usage = Viewport.USAGE_3D
	viewport.hdr = true
	viewport.keep_3d_linear = true
	viewport.size = Vector2(told["width"], told["height"])
	viewport.render_target_update_mode = Viewport.UPDATE_ALWAYS
	for quadrant in range(4):
		viewport.set_shadow_atlas_quadrant_subdiv(quadrant, Viewport.SHADOW_ATLAS_QUADRANT_SUBDIV_1)
	get_root().add_child(viewport)
	for one in told["objects"]:
		var shown = MeshInstance.new()
		shown.mesh = mesh_of(one["file"], one["corners"])
		shown.set_meta("casts", one["casts"])
		shown.set_meta("seen", one["seen"])
		viewport.add_child(shown)
		meshes.append(shown)
	add_camera(told["camera"], told["reach"])
	add_light(told["light"])

func add_camera(told, reach):
	var camera = Camera.new()
	viewport.add_child(camera)
	if told.has("orthographic_height"):
		camera.set_orthogonal(told["orthographic_height"], reach / 1000, reach)
	else:
		camera.set_perspective(told["vertical_fov_deg"], reach / 1000, reach)
	var eye = vector(told["eye"])
	camera.transform = looking(vector(told["target"]) - eye, vector(told["up"]), eye)
	camera.current = true
	camera.force_update_transform() # else at the end of this frame of the main loop, which comes after all that is drawn

func add_light(told):
	var forward = Vector3(0, -1, 0)
	var position = Vector3()
	if told["type"] == "directional":
		light = DirectionalLight.new()
		forward = vector(told["direction"])
	else:
		position = vector(told["position"])
		light = OmniLight.new()
		if told["type"] == "spot":
			light.free()
			light = SpotLight.new()
			light.spot_angle = told["cone_deg"] / 2
			light.spot_attenuation = 0
			forward = vector(told["target"]) - position
		else:
			light.omni_attenuation = 0
	viewport.add_child(light)
	var up = Vector3(0, 1, 0)
	if abs(forward.normalized().y) > 0.9:
		up = Vector3(1, 0, 0)
	light.transform = looking(forward, up, position)
	light.force_update_transform()

func material_of(code):
	var shader = Shader.new()
	shader.code = code
	var material = ShaderMaterial.new()
	material.shader = shader
	return material

# Godot's own material: white, matt, and dark where no light falls.
func white(cull):
	var material = SpatialMaterial.new()
	material.params_specular_mode = SpatialMaterial.SPECULAR_DISABLED
	material.flags_disable_ambient_light = true
	material.params_cull_mode = cull
	return material

func show(material):
	for shown in meshes:
		shown.material_override = material

func save(path):
	VisualServer.force_draw(false)
	var image = viewport.get_texture().get_data()
	image.flip_y()
	var file = File.new()
	file.open(path, File.WRITE)
	file.store_buffer(image.get_data())
	file.close()

func draw(told):
	ProjectSettings.set_setting("rendering/quality/shadows/filter_mode", int(told["filter_mode"]))
	viewport.shadow_atlas_size = int(told["atlas"])
	for name in told["light"]:
		light.set(name, told["light"][name])
	for shown in meshes:
		shown.cast_shadow = int(told["cast_shadow"])
		if not shown.get_meta("seen"):
			shown.cast_shadow = GeometryInstance.SHADOW_CASTING_SETTING_SHADOWS_ONLY
		if not shown.get_meta("casts"):
			shown.cast_shadow = GeometryInstance.SHADOW_CASTING_SETTING_OFF
		shown.visible = shown.get_meta("seen") or shown.get_meta("casts")
	show(whites[told["cull"]] if told["is_picture"] else material_of(LIGHT % told["cull"]))
	light.shadow_enabled = told["shadows"]
	save(told["folder"] + "/shadowed")
	light.shadow_enabled = false
	save(told["folder"] + "/unshadowed")
	var position = material_of(PASSES % [told["cull"], MINUS, PLUS])
	position.set_shader_param("scale", scene["scale"])
	show(position)
	for digit in range(DIGITS + 1):
		position.set_shader_param("digit", digit)
		save(told["folder"] + "/digit" + str(digit))
