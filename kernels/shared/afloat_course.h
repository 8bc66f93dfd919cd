/* The whole of a surface afloat: its extents, then everything at every draft. */
#ifndef BATTEN_SHARED_AFLOAT_COURSE_H
#define BATTEN_SHARED_AFLOAT_COURSE_H

#include "afloat_sections.h"

SHARED_FUNCTION void afloat_take_draft(const afloat_state *s, const real *extents, scalar draft_m,
                                       GLOBAL real *out)
{
	real form[AFLOAT_FORM_COUNT];
	const real high = extents[AFLOAT_HIGHEST] - extents[AFLOAT_LOWEST];
	const real at = SPREAD(draft_m);
	const afloat_draft draft = { at, FUSED(SPREAD(LITERAL(1e-14)), afloat_size(at) + high, at) };
	afloat_waterline line = { SPREAD(AFLOAT_FAR), SPREAD(-AFLOAT_FAR), SPREAD(-AFLOAT_FAR),
		                      SPREAD(s->lines[AFLOAT_U][0]), SPREAD(LITERAL(1e-9)) * high };
	ROLLED for (int n = 0; n < AFLOAT_SUM_COUNT; n++) form[n] = SPREAD(0);
	ROLLED for (int span = 0; span < s->spans[AFLOAT_U]; span++)
	{
		real breaks[AFLOAT_BREAKS];
		afloat_take_breaks(s, span, draft.edge, breaks);
		afloat_add_span(s, span, &draft, breaks, form);
		afloat_sample_waterline(s, span, draft.edge, breaks, &line);
	}
	afloat_add_ends(s, &draft, form);
	afloat_refine_waterline(s, draft.edge, &line);
	form[AFLOAT_LINE_AFT] = line.aft;
	form[AFLOAT_LINE_FORE] = line.fore;
	form[AFLOAT_LINE_HALF_BREADTH] = line.half_breadth;
	afloat_take_sections(s, extents, draft.edge, form);
	ROLLED for (int n = 0; n < AFLOAT_FORM_COUNT; n++) out[n] = form[n];
}

/* Each work-item takes drafts of its own. */
SHARED_FUNCTION void afloat_run_group(const afloat_state *s, GLOBAL real *out)
{
	real extents[AFLOAT_OUT_COUNT];
	afloat_take_extents(s, extents);
	afloat_take_bands(s, AFLOAT_U);
	afloat_take_bands(s, AFLOAT_V);
	if (WORK_ITEM == 0) {
		ROLLED for (int n = 0; n < AFLOAT_OUT_COUNT; n++) out[n] = extents[n];
	}
	ROLLED for (int d = WORK_ITEM; d < s->drafts; d += WORK_ITEMS)
	{
		afloat_take_draft(s, extents, s->drafts_m[d],
		                  out + AFLOAT_OUT_COUNT + d * AFLOAT_FORM_COUNT);
	}
}

#endif
