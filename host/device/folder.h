/* Folders for what is compiled: which one can be written, private ones, and their end. Nothing here
 * records an error: without a folder everything still works, only slower. */
#ifndef BATTEN_DEVICE_FOLDER_H
#define BATTEN_DEVICE_FOLDER_H

#include <stdbool.h>
#include <stddef.h>

enum { DEVICE_FOLDER_SIZE = 4096 };

/* Makes the folder and those above it (for the user only) and tries to write there. room: bytes that
 * must be free on its disk; code: programs must be allowed to run from it. */
bool device_folder_usable(const char *path, size_t room, bool code);

/* $XDG_CACHE_HOME/name, else $HOME/.cache/name; false when neither variable has an absolute path or
 * the result is longer than size. */
bool device_folder_of_user(const char *name, char *path, size_t size);

/* Makes a folder nobody else can look into, under $TMPDIR, /tmp or /var/tmp. */
bool device_folder_make_private(const char *name, size_t room, bool code, char *path, size_t size);

/* Removes the folder and all in it; does not follow links. */
void device_folder_remove(const char *path);

#endif
