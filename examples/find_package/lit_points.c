/* Which points on the ground does a table shadow? Decided exactly, from C.
 *
 *     lit_points */
#include <gnomon/gnomon.h>

#include <stdio.h>
#include <stdlib.h>

static void require(gnomon_status status)
{
    if (status != GNOMON_OK) {
        fprintf(stderr, "lit_points: %s\n", gnomon_last_error());
        exit(1);
    }
}

int main(void)
{
    const double vertices[] = {-1, 1, -1, -1, 1, 1, 1, 1, 1, 1, 1, -1};
    const uint32_t triangles[] = {0, 1, 2, 0, 2, 3};
    gnomon_scene *table = NULL;
    require(gnomon_scene_from_arrays(vertices, 4, triangles, 2, &table));

    const gnomon_light sun = {.kind = GNOMON_DIRECTIONAL, .direction = {-0.4, -1, -0.3}};
    double points[9 * 3];
    for (int i = 0; i < 9; ++i) {
        points[3 * i] = i / 2.0 - 2; /* from x = -2 to 2 */
        points[3 * i + 1] = 0;
        points[3 * i + 2] = 0.1;
    }
    uint8_t classes[9];
    require(gnomon_truth_in_space(table, &sun, points, 9, 0, (gnomon_truth){.classes = classes}));
    for (int i = 0; i < 9; ++i) {
        putchar(classes[i] == GNOMON_BLOCKED ? '#' : classes[i] == GNOMON_LIT ? '.' : '?');
    }
    printf("  Gnomon %s\n", gnomon_version());
    gnomon_scene_free(table);
    return 0;
}
