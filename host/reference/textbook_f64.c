#include "reference/textbook.h"

#define BATTEN_DOUBLE 1
#define TEXTBOOK_FUNCTION reference_textbook_f64
#include "reference/textbook_body.h"
