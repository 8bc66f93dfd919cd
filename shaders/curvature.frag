#version 450
/* Colour by curvature, thin lines along stations and waterlines, a touch of shading. */
layout(location = 0) in vec3 hull_normal;
layout(location = 1) in vec2 colour_known;
layout(location = 2) in vec2 grid_place;
layout(location = 3) in float half_breadth;

const int COLOUR_COUNT = 257; /* PICTURE_COLOUR_COUNT */
layout(set = 0, binding = 0) uniform Colours {
	vec4 colour[COLOUR_COUNT];
} colours;

layout(push_constant) uniform Draw {
	mat4 clip_from_hull;
	vec4 light_side;
	vec4 scale_lines;
	float thin;
} draw;

layout(location = 0) out vec4 pixel;

const vec3 NO_VALUE = vec3(0.80, 0.80, 0.80); /* hull without a curvature */
const vec3 INSIDE = vec3(0.62, 0.62, 0.60);   /* the inner side of the shell */

vec3 colour_of(float value)
{
	float place = 0.5 * (clamp(value, -1.0, 1.0) + 1.0) * float(COLOUR_COUNT - 1);
	int below = min(int(place), COLOUR_COUNT - 2);
	return mix(colours.colour[below].rgb, colours.colour[below + 1].rgb, place - float(below));
}

/* How much a pixel lies on the lines where place is whole. Fades where lines come so close that they
 * would hide the colours. */
float on_line(float place)
{
	float step_of_pixel = max(fwidth(place), 1e-6);
	float distance_px = abs(place - round(place)) / step_of_pixel;
	float sparse = clamp(1.5 - 12.0 * step_of_pixel, 0.0, 1.0);
	return sparse * (1.0 - smoothstep(0.5 * draw.scale_lines.z - 0.5, 0.5 * draw.scale_lines.z + 0.5,
	                                  distance_px));
}

void main()
{
	vec3 colour = mix(NO_VALUE, colour_of(colour_known.x), clamp(colour_known.y, 0.0, 1.0));
	float line = max(on_line(grid_place.x), on_line(grid_place.y));
	bool outside = gl_FrontFacing == (draw.light_side.w > 0.0) || half_breadth < draw.thin;
	vec3 normal = normalize(hull_normal);
	float lit = 0.5 + 0.5 * dot(outside ? normal : -normal, draw.light_side.xyz);
	float shade = 1.0 - draw.scale_lines.w * (1.0 - lit);
	vec3 surface = outside ? colour : INSIDE;
	pixel = vec4(mix(surface * shade, vec3(0.1), line * draw.scale_lines.y), 1.0);
}
