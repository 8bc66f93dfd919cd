#version 450
/* One half of a hull, mirrored by side for the other. Positions and normals are of the hull's frame:
 * x forward, y to port, z up. */
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 value_known;
layout(location = 3) in vec2 grid;

layout(push_constant) uniform Draw {
	mat4 clip_from_hull;
	vec4 light_side;  /* direction to the light; w: 1 port, -1 starboard */
	vec4 scale_lines; /* x: 1 / curvature at the end of the colours; y: line strength; z: line width
	                     in pixels; w: depth of the shading */
	float thin;       /* half-breadth below which both sides are one plane (stem, deadwood) */
} draw;

layout(location = 0) out vec3 hull_normal;
layout(location = 1) out vec2 colour_known;
layout(location = 2) out vec2 grid_place;
layout(location = 3) out float half_breadth;

void main()
{
	vec3 mirror = vec3(1.0, draw.light_side.w, 1.0);
	gl_Position = draw.clip_from_hull * vec4(position * mirror, 1.0);
	hull_normal = normal * mirror;
	colour_known = vec2(value_known.x * draw.scale_lines.x, value_known.y);
	grid_place = grid;
	half_breadth = position.y;
}
