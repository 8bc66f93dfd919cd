#include "reference/textbook.h"

#define BATTEN_DOUBLE 0
#define TEXTBOOK_FUNCTION reference_textbook_f32
#include "reference/textbook_body.h"
