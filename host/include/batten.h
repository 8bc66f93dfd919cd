/*
 * batten: fairs ship hulls in bulk.
 *
 * The whole public interface; each part also stands alone. Frame inside: origin at the aft
 * perpendicular on the baseline, x forward, y to port, z up; metres; a hull is stored as its half,
 * y >= 0. Other frames and units are converted where a file is read or written, never inside.
 *
 *   base.h                        status, version, context: what every call has in common
 *   device.h                      the devices of the machine, and batches on them
 *   hull.h, surface.h, curve.h    offset tables, B-spline surfaces, single lines: read, made, written, measured
 *   vary.h                        variants of a parent hull
 *   search.h, net.h, pass.h       batches of pattern searches over offsets and over control nets, of
 *                                 forward and inverse fairing
 *   fairing.h                     one hull faired from beginning to end
 *   hydrostatics.h                offsets, surfaces and meshes over drafts, one or many
 *   sweep.h                       a plan of many designs, run into a database; its report
 *   picture.h                     lines plans, curvature maps, charts
 *
 * Rules that hold for every declaration
 *   - A function that can fail returns batten_status and leaves its outputs untouched (pointers
 *     NULL) when it does; batten_context_error() then gives one line that says what was wrong.
 *   - Input arrays are borrowed for the call only. What a function creates, the caller destroys;
 *     destroying NULL is allowed.
 *   - Option structs are filled by their _default() function first, then changed.
 *   - One context is used by one thread at a time; different contexts are independent.
 *
 * Sources: "thesis" is E. Narli, Computer Aided Fairing of Ship Hull Forms (ITU 1999); "Letcher" is
 * J. S. Letcher, The Geometry of Ships (SNAME 2009).
 */
#ifndef BATTEN_H
#define BATTEN_H

#include "batten/base.h"
#include "batten/curve.h"
#include "batten/device.h"
#include "batten/fairing.h"
#include "batten/hull.h"
#include "batten/hydrostatics.h"
#include "batten/net.h"
#include "batten/pass.h"
#include "batten/picture.h"
#include "batten/search.h"
#include "batten/surface.h"
#include "batten/sweep.h"
#include "batten/vary.h"

#endif
