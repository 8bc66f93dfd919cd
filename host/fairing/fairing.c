/* The parts of a fairing. */
#include "fairing/fairing.h"

void batten_fairing_destroy(batten_fairing *fairing)
{
	if (!fairing)
		return;
	batten_hull_destroy(fairing->input);
	batten_hull_destroy(fairing->smoothed);
	batten_hull_destroy(fairing->faired);
	batten_surface_destroy(fairing->fitted_surface);
	batten_surface_destroy(fairing->faired_surface);
	batten_release(fairing->context, fairing->locked);
	batten_release(fairing->context, fairing->replacements);
	batten_release(fairing->context, fairing->rows);
	batten_release(fairing->context, fairing);
}

const batten_hull *batten_fairing_input(const batten_fairing *fairing)
{
	return fairing->input;
}

const batten_hull *batten_fairing_smoothed(const batten_fairing *fairing)
{
	return fairing->smoothed;
}

const batten_hull *batten_fairing_faired(const batten_fairing *fairing)
{
	return fairing->faired;
}

size_t batten_fairing_replacement_count(const batten_fairing *fairing)
{
	return fairing->replacement_count;
}

const batten_replacement *batten_fairing_replacements(const batten_fairing *fairing)
{
	return fairing->replacements;
}

const batten_search_result *batten_fairing_result(const batten_fairing *fairing)
{
	return &fairing->result;
}

const batten_certificate *batten_fairing_certificate(const batten_fairing *fairing)
{
	return fairing->certified ? &fairing->certificate : NULL;
}

const batten_run *batten_fairing_run(const batten_fairing *fairing)
{
	return &fairing->run;
}

batten_fairing_facts batten_fairing_describe(const batten_fairing *fairing)
{
	return fairing->facts;
}

const batten_kept *batten_fairing_kept(const batten_fairing *fairing, size_t *count,
                                       unsigned *rounds)
{
	*count = fairing->kept_count;
	if (rounds)
		*rounds = fairing->kept_rounds;
	return fairing->kept;
}

const batten_surface *batten_fairing_fitted_surface(const batten_fairing *fairing)
{
	return fairing->fitted_surface;
}

const batten_surface *batten_fairing_faired_surface(const batten_fairing *fairing)
{
	return fairing->faired_surface;
}

batten_fairing_net batten_fairing_describe_net(const batten_fairing *fairing)
{
	return fairing->net;
}

size_t batten_fairing_row_count(const batten_fairing *fairing)
{
	return fairing->row_count;
}

const batten_fairing_row *batten_fairing_rows(const batten_fairing *fairing)
{
	return fairing->rows;
}

batten_fairing_pass batten_fairing_describe_pass(const batten_fairing *fairing)
{
	return fairing->pass;
}
