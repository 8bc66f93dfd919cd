#include "picture/colour_map.h"

#include <math.h>

/* Each arm runs straight through CIELAB at one hue: lightness falls from the neutral colour while
 * chroma rises, so that equal steps of curvature look equally far apart on both arms. Blue against
 * orange-red stays distinct for the common colour-vision deficiencies, and the two ends have the
 * same lightness, so that neither sign looks more important. */
static const double neutral_lightness = 94.0;
static const double end_lightness = 38.0;
static const double pi = 3.14159265358979323846;

typedef struct arm {
	double hue_degrees, chroma;
} arm;
static const arm concave = { .hue_degrees = 285.0, .chroma = 56.0 };
static const arm convex = { .hue_degrees = 40.0, .chroma = 80.0 };

/* Inverse of the CIELAB compression. */
static double expand(double value)
{
	double edge = 6.0 / 29.0;
	return value > edge ? value * value * value : 3.0 * edge * edge * (value - 4.0 / 29.0);
}

/* Linear light to the coded value of sRGB (IEC 61966-2-1), cut to what a screen has. */
static double encode(double light)
{
	double coded = light <= 0.0031308 ? 12.92 * light : 1.055 * pow(light, 1.0 / 2.4) - 0.055;
	return coded < 0.0 ? 0.0 : coded > 1.0 ? 1.0 : coded;
}

static void encode_lab(double lightness, double a, double b, float rgba[4])
{
	double middle = (lightness + 16.0) / 116.0;
	double x = 0.95047 * expand(middle + a / 500.0);
	double y = expand(middle);
	double z = 1.08883 * expand(middle - b / 200.0);
	rgba[0] = (float)encode(3.2406 * x - 1.5372 * y - 0.4986 * z);
	rgba[1] = (float)encode(-0.9689 * x + 1.8758 * y + 0.0415 * z);
	rgba[2] = (float)encode(0.0557 * x - 0.2040 * y + 1.0570 * z);
	rgba[3] = 1.0F;
}

void picture_colour_map_fill(picture_colour_map *map)
{
	int middle = PICTURE_COLOUR_COUNT / 2;
	for (int i = 0; i < PICTURE_COLOUR_COUNT; i++) {
		double part = fabs((double)(i - middle)) / middle;
		const arm *side = i < middle ? &concave : &convex;
		double angle = side->hue_degrees * pi / 180.0;
		double lightness = neutral_lightness + part * (end_lightness - neutral_lightness);
		double chroma = part * side->chroma;
		encode_lab(lightness, chroma * cos(angle), chroma * sin(angle), map->rgba[i]);
	}
}

void picture_colour_map_look_up(const picture_colour_map *map, double value, double rgb[3])
{
	double clamped = value < -1.0 ? -1.0 : value > 1.0 ? 1.0 : value;
	double place = 0.5 * (clamped + 1.0) * (PICTURE_COLOUR_COUNT - 1);
	int below = (int)place;
	if (below > PICTURE_COLOUR_COUNT - 2)
		below = PICTURE_COLOUR_COUNT - 2;
	double part = place - below;
	for (int channel = 0; channel < 3; channel++)
		rgb[channel] = (1.0 - part) * (double)map->rgba[below][channel] +
		               part * (double)map->rgba[below + 1][channel];
}
