/* Where the optional parts of batten lie: files that are built or installed beside the program. */
#ifndef BATTEN_CORE_INSTALLED_H
#define BATTEN_CORE_INSTALLED_H

#include <stdbool.h>

enum { INSTALLED_PATH_SIZE = 4096 };

/* The file of this name: in the folder BATTEN_MODULE_PATH where that is set; otherwise beside the
 * program or library and where the installation has such files. False: there is none that can be
 * read. */
bool installed_find(const char *name, char path[INSTALLED_PATH_SIZE]);

#endif
