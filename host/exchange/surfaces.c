/* Surfaces in files of any of the formats: .json, .igs, .iges, .stp, .step. */
#include "core/file.h"
#include "exchange/module.h"

#include <stdarg.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

/* Longest IGES or STEP file that is read. */
enum { LONGEST = 256 * 1024 * 1024, NOTE_SIZE = 384, NOTES_MOST = 1000 };

struct batten_surfaces {
	batten_context *context;
	batten_surface **surfaces;
	char (*notes)[NOTE_SIZE];
	size_t count, room, note_count, note_room;
};

typedef enum file_kind {
	KIND_JSON,
	KIND_IGES,
	KIND_STEP,
	KIND_UNKNOWN,
} file_kind;

static file_kind kind_of(const char *path)
{
	static const struct {
		const char *ending;
		file_kind kind;
	} endings[] = { { ".json", KIND_JSON },
		            { ".igs", KIND_IGES },
		            { ".iges", KIND_IGES },
		            { ".stp", KIND_STEP },
		            { ".step", KIND_STEP } };
	const size_t length = strlen(path);
	for (size_t i = 0; i < sizeof endings / sizeof endings[0]; i++) {
		const size_t of_ending = strlen(endings[i].ending);
		if (length > of_ending && strcasecmp(path + length - of_ending, endings[i].ending) == 0)
			return endings[i].kind;
	}
	return KIND_UNKNOWN;
}

static batten_status fail_kind(batten_context *context, const char *path)
{
	return batten_fail(context, BATTEN_USAGE,
	                   "%s: expected a name that ends in .json, .igs, .iges, .stp or .step", path);
}

/* ------------------------------------------------------------------------------------------------
 * The list
 * --------------------------------------------------------------------------------------------- */

void batten_surfaces_destroy(batten_surfaces *list)
{
	if (!list)
		return;
	batten_context *context = list->context;
	for (size_t i = 0; i < list->count; i++)
		batten_surface_destroy(list->surfaces[i]);
	batten_release(context, list->surfaces);
	batten_release(context, list->notes);
	batten_release(context, list);
}

size_t batten_surfaces_count(const batten_surfaces *list)
{
	return list->count;
}

const batten_surface *batten_surfaces_at(const batten_surfaces *list, size_t i)
{
	return i < list->count ? list->surfaces[i] : NULL;
}

size_t batten_surfaces_warning_count(const batten_surfaces *list)
{
	return list->note_count;
}

const char *batten_surfaces_warning(const batten_surfaces *list, size_t i)
{
	return i < list->note_count ? list->notes[i] : NULL;
}

/* Room for one entry more; the array may move. */
static batten_status make_room(batten_context *context, void **array, size_t size, size_t count,
                               size_t *room)
{
	if (count < *room)
		return BATTEN_OK;
	const size_t more = *room > 0 ? 2 * *room : 8;
	void *larger = batten_allocate(context, more, size);
	if (!larger)
		return BATTEN_MEMORY;
	if (count > 0)
		memcpy(larger, *array, count * size);
	batten_release(context, *array);
	*array = larger;
	*room = more;
	return BATTEN_OK;
}

static batten_status add_surface(batten_surfaces *list, batten_surface *surface)
{
	void *array = list->surfaces;
	const batten_status status = make_room(list->context, &array, sizeof *list->surfaces,
	                                       list->count, &list->room);
	list->surfaces = array;
	if (status == BATTEN_OK)
		list->surfaces[list->count++] = surface;
	return status;
}

static batten_status add_note(batten_surfaces *list, const char *format, ...)
	__attribute__((format(printf, 2, 3)));

static batten_status add_note(batten_surfaces *list, const char *format, ...)
{
	void *array = list->notes;
	if (list->note_count == NOTES_MOST)
		return BATTEN_OK;
	const batten_status status = make_room(list->context, &array, sizeof *list->notes,
	                                       list->note_count, &list->note_room);
	list->notes = array;
	if (status != BATTEN_OK)
		return status;
	char *note = list->notes[list->note_count++];
	va_list arguments;
	va_start(arguments, format);
	(void)vsnprintf(note, NOTE_SIZE, format, arguments);
	va_end(arguments);
	for (char *c = note; *c; c++)
		if ((unsigned char)*c < 0x20 || *c == 0x7f)
			*c = '?';
	return BATTEN_OK;
}

/* ------------------------------------------------------------------------------------------------
 * Reading
 * --------------------------------------------------------------------------------------------- */

typedef struct reading {
	batten_surfaces *list;
	const char *path;
	batten_status status;
} reading;

/* A surface beyond what batten knows is left out by name, like the entities it does not know. */
static bool take_surface(void *user, const batten_surface_net *net)
{
	reading *r = user;
	batten_context *context = r->list->context;
	batten_surface *surface = NULL;
	r->status = batten_surface_create(context, net, &surface);
	if (r->status == BATTEN_USAGE) {
		r->status = add_note(r->list, "%s: the surface '%s' is left out: %s", r->path, net->name,
		                     batten_context_error(context));
		return r->status == BATTEN_OK;
	}
	if (r->status == BATTEN_OK)
		r->status = add_surface(r->list, surface);
	if (r->status != BATTEN_OK)
		batten_surface_destroy(surface);
	return r->status == BATTEN_OK;
}

static bool take_left_out(void *user, unsigned long count, const char *kind, const char *why)
{
	reading *r = user;
	r->status = add_note(r->list, "%s: left out: %lu x %s: %s", r->path, count, kind, why);
	return r->status == BATTEN_OK;
}

/* A pipe would be waited for, a folder be read as an empty file. */
static batten_status check_file(batten_context *context, const char *path)
{
	struct stat facts;
	char *text = NULL;
	size_t length = 0;
	if (stat(path, &facts) == 0 && !S_ISREG(facts.st_mode) && !S_ISDIR(facts.st_mode))
		return batten_fail(context, BATTEN_IO, "%s: is no plain file", path);
	if (stat(path, &facts) == 0 && S_ISREG(facts.st_mode)) {
		if (facts.st_size > LONGEST)
			return batten_fail(context, BATTEN_INPUT, "%s: longer than %d bytes", path, LONGEST);
		if (facts.st_size == 0)
			return batten_fail(context, BATTEN_INPUT, "%s: is empty", path);
		FILE *stream = fopen(path, "rb");
		if (stream) {
			(void)fclose(stream);
			return BATTEN_OK;
		}
	}
	const batten_status status = batten_file_read(context, path, 0, &text, &length);
	batten_release(context, text);
	return status;
}

static batten_status read_module(const char *path, file_kind kind, batten_surfaces *list)
{
	batten_context *context = list->context;
	reading r = { list, path, BATTEN_OK };
	const module_task task = { kind == KIND_IGES ? EXCHANGE_IGES : EXCHANGE_STEP, path, 0, NULL };
	const exchange_sink sink = { &r, take_surface, take_left_out, NULL };
	batten_status status = check_file(context, path);
	if (status == BATTEN_OK)
		status = module_work(context, &task, &sink);
	if (status == BATTEN_INTERRUPTED)
		status = r.status != BATTEN_OK
		             ? r.status
		             : batten_fail(context, BATTEN_INPUT, "%s: the file is damaged", path);
	if (status == BATTEN_OK && list->count == 0)
		status = batten_fail(context, BATTEN_INPUT, "%s%s%s", path,
		                     list->note_count > 0 ? ": no whole B-spline surface in it; "
		                                          : ": no B-spline surface in it",
		                     list->note_count > 0 ? list->notes[0] + strlen(path) + 2 : "");
	return status;
}

batten_status batten_surfaces_read(batten_context *context, const char *path, batten_surfaces **out)
{
	const file_kind kind = kind_of(path);
	if (kind == KIND_UNKNOWN)
		return fail_kind(context, path);
	batten_surfaces *list = batten_allocate(context, 1, sizeof *list);
	if (!list)
		return BATTEN_MEMORY;
	list->context = context;
	batten_surface *surface = NULL;
	batten_status status;
	if (kind == KIND_JSON) {
		status = batten_surface_read(context, path, &surface);
		if (status == BATTEN_OK) {
			status = add_surface(list, surface);
			if (status != BATTEN_OK)
				batten_surface_destroy(surface);
		}
	} else
		status = read_module(path, kind, list);
	if (status != BATTEN_OK) {
		batten_surfaces_destroy(list);
		return status;
	}
	for (size_t i = 0; i < list->note_count; i++)
		batten_log(context, BATTEN_LOG_WARNING, "%s", list->notes[i]);
	*out = list;
	return BATTEN_OK;
}

/* ------------------------------------------------------------------------------------------------
 * Writing
 * --------------------------------------------------------------------------------------------- */

static bool put_bytes(void *user, const char *bytes, size_t count)
{
	FILE *stream = user;
	return fwrite(bytes, 1, count, stream) == count;
}

static batten_status write_module(batten_context *context, const module_task *task)
{
	batten_file file;
	batten_status status = batten_file_open(context, task->path, &file);
	if (status != BATTEN_OK)
		return status;
	const exchange_sink sink = { file.stream, NULL, NULL, put_bytes };
	status = module_work(context, task, &sink);
	/* What stdio refused comes out when the file is committed. */
	if (status == BATTEN_INTERRUPTED && !ferror(file.stream))
		status = batten_fail(context, BATTEN_INTERNAL, "%s: OpenCASCADE gave no file", task->path);
	if (status == BATTEN_OK || status == BATTEN_INTERRUPTED)
		return batten_file_commit(context, &file);
	batten_file_abandon(context, &file);
	return status;
}

/* What the formats cannot hold: knots all in one place once numbers below 1e-99 are 0; and OpenCASCADE
 * reads weights below 1e-7 as if all were 1. */
static batten_status check_net(batten_context *context, const char *path,
                               const batten_surface_net *net)
{
	const double range_u = net->knots_u[net->count_u] - net->knots_u[net->order_u - 1];
	const double range_v = net->knots_v[net->count_v] - net->knots_v[net->order_v - 1];
	if (range_u < 1e-80 || range_v < 1e-80)
		return batten_fail(context, BATTEN_USAGE,
		                   "%s: the knots of '%s' span less than 1e-80, too little for the format",
		                   path, net->name);
	for (size_t i = 0; net->weights && i < net->count_u * net->count_v; i++)
		if (net->weights[i] < 1e-6)
			return batten_fail(context, BATTEN_USAGE,
			                   "%s: '%s' has a weight of %g, the least of the format is 1e-6", path,
			                   net->name, net->weights[i]);
	return BATTEN_OK;
}

batten_status batten_surfaces_write(batten_context *context, size_t count,
                                    const batten_surface *const *surfaces, const char *path)
{
	const file_kind kind = kind_of(path);
	if (kind == KIND_UNKNOWN)
		return fail_kind(context, path);
	if (count == 0)
		return batten_fail(context, BATTEN_USAGE, "%s: no surface to write", path);
	if (kind == KIND_JSON && count > 1)
		return batten_fail(context, BATTEN_USAGE,
		                   "%s: %zu surfaces, but a .json file holds one: choose one", path, count);
	if (kind == KIND_JSON)
		return batten_surface_write(context, surfaces[0], path);
	batten_surface_net *nets = batten_allocate(context, count, sizeof *nets);
	if (!nets)
		return BATTEN_MEMORY;
	batten_status status = BATTEN_OK;
	for (size_t i = 0; i < count && status == BATTEN_OK; i++) {
		nets[i] = batten_surface_describe(surfaces[i]);
		status = check_net(context, path, &nets[i]);
	}
	const module_task task = { kind == KIND_IGES ? EXCHANGE_IGES : EXCHANGE_STEP, path, count,
		                       nets };
	if (status == BATTEN_OK)
		status = write_module(context, &task);
	batten_release(context, nets);
	return status;
}
