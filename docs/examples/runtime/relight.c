/* SPDX-License-Identifier: MIT */
/* relight SCENE.limnrt [BOUNCES]: lifts the first light by 10 cm, lets it bounce, 100 times at most, and prints the mean irradiance, and
   what may be missing where that was too few. */
#include <limn_runtime.h>
#include <stdio.h>
#include <stdlib.h>

int main(int count, char** arguments) {
    FILE* file = count == 2 || count == 3 ? fopen(arguments[1], "rb") : NULL;
    if (!file || fseek(file, 0, SEEK_END) != 0)
        return 2;
    const size_t size = (size_t)ftell(file);
    void* bytes = aligned_alloc(64, (size + 63) / 64 * 64);
    rewind(file);
    char error[256] = "cannot be read";
    limnrt_scene* scene = bytes && fread(bytes, 1, size, file) == size
                              ? limnrt_open(bytes, size, NULL, error, sizeof error) : NULL;
    fclose(file);
    if (!scene) {
        fprintf(stderr, "%s: %s\n", arguments[1], error);
        return 1;
    }
    limnrt_counts counts;
    limnrt_get_counts(scene, &counts);
    if (counts.lights > 0) {
        limnrt_light light = limnrt_file_lights(scene)[0];
        light.position[1] += 0.1f;
        limnrt_set_lights(scene, &light, 1);
    }
    const unsigned bounces = limnrt_converge(scene, count == 3 ? (unsigned)atoi(arguments[2]) : 100);
    const size_t texels = (size_t)counts.lightmap_width * counts.lightmap_height;
    float* rgba = malloc(texels * 4 * sizeof *rgba);
    limnrt_lightmap_irradiance(scene, NULL, rgba);
    double sum = 0, covered = 0;
    for (size_t t = 0; t < texels; ++t)
        sum += rgba[4 * t + 1], covered += rgba[4 * t + 3];
    printf("%u bounces, mean irradiance %.6g W/m^2\n", bounces, covered > 0 ? sum / covered : 0);
    if (limnrt_missing(scene) > 1e-4f) /* the tolerance, unless limnrt_set_tolerance() has set another */
        printf("ended early: %.2g %% of the light may be missing\n", 100 * limnrt_missing(scene));
    free(rgba), limnrt_close(scene), free(bytes);
    return 0;
}
