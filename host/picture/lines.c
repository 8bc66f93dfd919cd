#include "picture/lines_page.h"
#include "picture/svg_file.h"

batten_status batten_picture_lines(batten_context *context, const batten_hull *before,
                                   const batten_hull *after, const char *path)
{
	lines_page page = { .context = context, .before = before, .after = after };
	batten_status status = lines_page_lay_out(&page);
	if (status != BATTEN_OK)
		return status;
	svg_file svg;
	status = svg_file_begin(context, LINES_PAGE_WIDTH, LINES_PAGE_HEIGHT, &svg);
	if (status != BATTEN_OK)
		return status;
	page.cairo = svg.cairo;
	cairo_set_source_rgb(svg.cairo, 1.0, 1.0, 1.0);
	cairo_paint(svg.cairo);
	status = lines_page_draw_plans(&page);
	lines_page_draw_legend(&page);
	if (status != BATTEN_OK) {
		svg_file_abandon(&svg);
		return status;
	}
	return svg_file_end(&svg, path);
}
