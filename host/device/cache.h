/* Compiled programs on disk, one file each, named by a hash of everything that went in. A cache that
 * cannot be read or written is no error. Files are replaced at once, so that processes may share it. */
#ifndef BATTEN_DEVICE_CACHE_H
#define BATTEN_DEVICE_CACHE_H

#include "core/context.h"

typedef struct device_cache {
	char *folder;    /* NULL: there is none */
	bool is_private; /* removed with the cache */
} device_cache;

typedef struct device_cache_key {
	unsigned char bytes[16];
} device_cache_key;

/* The folder of the context's options, of the user, or a private one. */
void device_cache_open(batten_context *context, device_cache *out);
void device_cache_close(batten_context *context, device_cache *cache);

/* The version of batten and the device go into the key too. */
device_cache_key device_cache_key_of(const batten_device *device, const char *source,
                                     const char *options);

/* *binary is released by the caller. False when there is none or it is not what was stored. */
bool device_cache_load(batten_context *context, const device_cache *cache,
                       const device_cache_key *key, unsigned char **binary, size_t *length);
void device_cache_store(const device_cache *cache, const device_cache_key *key,
                        const unsigned char *binary, size_t length);

#endif
