/* The readers of triangles, STL and OBJ, against arbitrary bytes. What they accept must be sound triangles
 * that can be measured; what they refuse must come with a message that names the file. */
#define FUZZ_PROGRAM "fuzz_mesh"
#define FUZZ_OWN_MESSAGES
#include "fuzz.h"

#include <math.h>

static void check_mesh(batten_context *context, const batten_mesh *mesh)
{
	const batten_mesh_facts facts = batten_mesh_describe(mesh);
	require(facts.vertex_count >= 3 && facts.triangle_count >= 1, "counts", "too few");
	require(isfinite(facts.area_m2) && facts.area_m2 >= 0, "area", "no number");
	require(facts.lowest_m <= facts.highest_m && facts.aftmost_m <= facts.foremost_m, "extents",
	        "turned");
	const double draft_m = facts.lowest_m + 0.5 * (facts.highest_m - facts.lowest_m);
	batten_hydrostatics measured;
	const batten_status status = batten_mesh_hydrostatics(context, mesh, NULL, 1, &draft_m,
	                                                      &measured);
	/* A flat one has no depth to float at. */
	require(status == BATTEN_OK || status == BATTEN_USAGE || status == BATTEN_INPUT, "hydrostatics",
	        batten_context_error(context));
}

static void fuzz_as(batten_context *context, const char *name, const uint8_t *data, size_t size)
{
	batten_mesh *mesh = NULL;
	const batten_status status = batten_mesh_parse(context, name, (const char *)data, size, &mesh);
	if (status == BATTEN_OK) {
		check_mesh(context, mesh);
	} else {
		const char *message = batten_context_error(context);
		require(mesh == NULL, "output of a refusal", "not NULL");
		check_line(status, message);
		require(status == BATTEN_MEMORY || strncmp(message, name, strlen(name)) == 0,
		        "message with the file", message);
	}
	batten_mesh_destroy(mesh);
}

static void fuzz_one(batten_context *context, const uint8_t *data, size_t size)
{
	fuzz_as(context, "input.stl", data, size);
	fuzz_as(context, "input.obj", data, size);
}
