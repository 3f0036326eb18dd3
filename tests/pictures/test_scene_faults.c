// test_scene_faults.c: checks that each problem in a scene is reported once per position, and that the rest is drawn.
#include "drawn.h"

#include <unistd.h>

// A red ball in the centre of the picture. It must be visible in all cases.
#define BALL                                                                                                           \
    "!window size=64;64\n"                                                                                             \
    "    !canvas3d id=:me viewpoint=0;0;4 near=0.1 far=9\n"                                                            \
    "        !light color=1\n"                                                                                         \
    "        !sphere color=1;0;0\n"

static const char *const files[][2] = {
    {"hole.obj", "v 0 0 0\nv 1 0 0\n\nf 1 2 3\n"},
    {"cut.stl", "solid cut\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0\n"},
    {"empty.stl", "solid empty\nendsolid empty\n"},
    {"damaged.png", "\x89PNG\r\n\x1a\nno picture"},
};

typedef struct Row {
    const char *name;
    const char *script;   // lines that are appended to BALL
    const char *reported; // expected diagnostics; NULL: any diagnostic about an unreadable file
} Row;

static const Row rows[] = {
    {"missing models", "        !model filename='none.obj' color=1\n        !model filename='none.stl' color=1\n",
     "5 [cannot-read] !model: cannot read 'none.obj': No such file or directory\n"
     "6 [cannot-read] !model: cannot read 'none.stl': No such file or directory\n"},
    {"damaged models",
     "        for i in ..3\n            !model filename='hole.obj' color=1 position=i\n"
     "        !model filename='cut.stl' color=1\n        !model filename='empty.stl' color=1\n",
     "6 [cannot-read] !model: hole.obj:4: a face refers to a vertex that does not exist\n"
     "7 [cannot-read] !model: cut.stl:5: 'vertex' needs three numbers, and a loop needs three vertices\n"
     "8 [cannot-read] !model: cannot read 'empty.stl': it contains no triangles\n"},
    {"models with bad numbers",
     "        !model vertices=0;0;0;1;0;0;0;1;0 faces=0;1;3 color=1\n        !model vertices=0;0;0 color=1\n"
     "        !model vertices=1;2 faces=0;1;2 color=1\n",
     "5 [bad-model] !model: 'faces' refers to a vertex that does not exist\n"
     "6 [bad-model] !model: a model without faces can have at most 2000 vertices, which must not all lie in one plane\n"
     "7 [bad-model] !model: 'vertices' needs three numbers per vertex, 'faces' three per face and 'uv' two per "
     "vertex\n"},
    {"solids of models that are not closed",
     "        !union color=0;1;0 position=-1.5;0;0\n            !model vertices=0;0;0;1;0;0;0;1;0 faces=0;1;2\n"
     "            !box size=0.5\n            !light color=1\n            !material\n                !box\n"
     "        !model vertices=0;0;0;1;0;0;0;1;0;0;0;1 faces=0;2;1;0;1;3;0;3;2 repair=true color=0;1;0 "
     "position=1.5;0;0\n",
     "8 [misplaced-node] !light: has no effect inside a solid; ignored\n"
     "9 [misplaced-node] !material: has no effect inside a solid; ignored\n"
     "6 [open-model] !model: the model has holes, so it is drawn unchanged; 'repair=true' fills the holes\n"},
    {"solids of which nothing is left",
     "        !difference color=0;1;0 position=-1.5;0;0\n            !box\n            !box size=2\n"
     "        !union\n        !trim color=0;1;0 position=1.5;0;0\n            !box\n"
     "        !intersect\n            !box size=0/1\n            !sphere position=1e30\n"
     "        !union\n            !model filename='none.obj' repair=true\n            !transform scale=1e300\n"
     "                !box size=1e300\n",
     "5 [empty-solid] !difference: nothing is left of the models inside\n"
     "8 [empty-solid] !union: nothing is left of the models inside\n"
     "9 [missing-attribute] !trim: 'normal' is missing; nothing is cut away\n"
     "11 [empty-solid] !intersect: nothing is left of the models inside\n"
     "15 [cannot-read] !model: cannot read 'none.obj': No such file or directory\n"
     "14 [empty-solid] !union: nothing is left of the models inside\n"},
    {"distance fields without a surface",
     "        !sdf color=0;1;0 resolution=1e-9\n            !sphere\n"
     "        !sdf color=0;1;0 min=2\n            !sphere\n"
     "        !sdf color=0;1;0 max=-2\n            !sphere\n"
     "        !mix\n            !sphere\n"
     "        !sdf color=0;1;0 position=1.5;0;0 max=9\n            !light color=1\n            !box size=0\n"
     "            !mix weights=1;-1\n                !sphere\n                !box\n",
     "11 [misplaced-node] !mix: has no effect outside a distance field; ignored\n"
     "5 [bad-resolution] !sdf: 'resolution' is too small: at most 1024 samples along an axis and 4 million points are "
     "possible\n"
     "7 [empty-solid] !sdf: the distance field has no surface in its box\n"
     "9 [empty-solid] !sdf: the distance field has no surface in its box\n"
     "14 [misplaced-node] !light: has no effect inside a distance field; ignored\n"
     "13 [empty-solid] !sdf: the distance field has no surface in its box\n"},
    {"functions of distance fields that do not return distances",
     "        !sdf color=0;1;0 function=f where f=3\n"
     "        !sdf color=0;1;0 function=(func(p) 'text')\n"
     "        !sdf color=0;1;0 function=(func(p) 0/p[0]*0)\n"
     "        !sdf color=0;1;0 function=(func(p) p) resolution=1e-9\n"
     "        !sdf color=0;1;0 function=(func(p) nothing)\n"
     "            !sphere\n"
     "        !sdf color=0;1;0 position=2;0;0 function=(func(p) hypot(p)-1/(p[0] > -0.5))\n"
     "        !sdf color=0;1;0 position=2;0;0 size=0.5\n"
     "            !sdf position=0.5;0;0 function=(func(p, r=0.5) hypot(p)-r)\n",
     "9 [unbound-name] unbound name 'nothing' is null\n"
     "5 [bad-attribute] !sdf: function should be a function, not 3\n"
     "6 [bad-function] !sdf: the function must return a finite number, but for the point "
     "-1.03125;-1.03125;-1.03125 it returns 'text'; such points are outside\n"
     "7 [bad-function] !sdf: the function must return a finite number, but for the point "
     "0;-1.03125;-1.03125 it returns nan; such points are outside\n"
     "9 [bad-function] !sdf: the function must return a finite number, but for the point "
     "-1.03125;-1.03125;-1.03125 it returns null; such points are outside\n"
     "11 [bad-function] !sdf: the function must return a finite number, but for the point "
     "-1.03125;-1.03125;-1.03125 it returns -inf; such points are outside\n"
     "5 [empty-solid] !sdf: the distance field has no surface in its box\n"
     "6 [empty-solid] !sdf: the distance field has no surface in its box\n"
     "7 [empty-solid] !sdf: the distance field has no surface in its box\n"
     "8 [bad-resolution] !sdf: 'resolution' is too small: at most 1024 samples along an axis and 4 million points are "
     "possible\n"
     "9 [empty-solid] !sdf: the distance field has no surface in its box\n"},
    {"missing textures", "        !box position=-1.5;0;0 color=0;1;0 color_id=:none emissive_id=''\n", ""},
    {"textures that refer to each other",
     "        !camera id=:a secondary=true size=32;32\n        !camera id=:b secondary=true size=32;32\n"
     "        !box position=-1.5;0;0 color=1 color_id=:me\n        !box position=-1.5;1;0 color=1 color_id=:a\n"
     "        !box position=1.5;0;0 color=1 color_id=:b emissive_id=:a transparency_id=:me\n",
     ""},
    {"cameras of invalid size",
     "        !camera id=:a secondary=true size=100000;4\n        !camera id=:b secondary=true size=0;4\n",
     "5 [bad-size] !camera: a picture can have 1 to 16384 pixels in width and height\n"
     "6 [bad-size] !camera: a picture can have 1 to 16384 pixels in width and height\n"},
    {"a scene of invalid size", "    !canvas3d size=4;100000\n        !light color=1\n",
     "5 [bad-size] !canvas3d: a picture can have 1 to 16384 pixels in width and height\n"},
    {"nan and infinity in transforms",
     "        !group translate=0/0 rotate=1/0 shear_x=0/0\n            !box position=3;0;0 size=0/0 rotation=1/0\n",
     "5 [bad-attribute] !group: translate should be one number or three, not nan\n"
     "5 [bad-attribute] !group: rotate should be numbers, not inf\n"
     "5 [bad-attribute] !group: shear_x should be one number or two, not nan\n"
     "6 [bad-attribute] !box: size should be one number or three, not nan\n"
     "6 [bad-attribute] !box: rotation should be one number or three, not inf\n"},
    {"nan and infinity in lights",
     "        !light color=0/0\n        !light color=1e-9 position=0/0 direction=1/0 radius=0/0 falloff=0/0\n",
     "5 [bad-attribute] !light: color should be one number or three, not nan\n"
     "6 [bad-attribute] !light: position should be one number or three, not nan\n"
     "6 [bad-attribute] !light: direction should be one number or three, not inf\n"
     "6 [bad-attribute] !light: radius should be number, not nan\n"
     "6 [bad-attribute] !light: falloff should be one number or four, not nan\n"},
    {"numbers out of range for the GPU",
     "        !transform scale=1e300 translate=1e300 rotate_x=1e300 shear_y=1e300 matrix=1e200\n"
     "            !sphere size=1e300 position=1e300 color=1e300 emissive=-1e300 translucency=1e300\n"
     "        !sphere position=1.5;0;0 size=1e-300 color=1 translucency=1e-300\n"
     "        !cone start=0 end=1e300 radius=1e-300\n        !cylinder start=1e300 end=-1e300\n"
     "        !light color=1e-30 position=1e300 radius=1e300\n        !light color=1e-9 start=-1e300 end=1e300\n"
     "        !camera id=:c secondary=true size=16;16 position=1e300 focus=-1e300 up=0 near=-1 far=-1 fov=7.5 "
     "fog_max=1e300 "
     "fog_curve=-1 width=0 orthographic=true samples=1e9\n",
     ""},
    {"too many segments", "        !sphere segments=5000 position=1.5;0;0 size=0.1 color=1\n",
     "5 [too-many-segments] !sphere: the number of segments is limited to 1024\n"},
    {"damaged images",
     "        !box position=1.5;0;0 color=1 color_id=:hurt\n    !image id=:hurt filename='damaged.png' hidden=true\n"
     "    !image filename='none.png' hidden=true\n",
     NULL},
    {"unknown nodes", "        !sphere3 color=1\n            !sphere color=0;1;0\n        !rect size=1\n", "5 ["},
};

static void test_each_problem_is_reported_once(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char script[4000];
        Drawn drawn;
        snprintf(script, sizeof script, "%s%s", BALL, rows[i].script);
        drawn_open(&drawn, script, 3);
        if (!rows[i].reported)
            snprintf(drawn.reported, sizeof drawn.reported, "%s",
                     strstr(drawn.reported, "[cannot-read]") ? "" : "nothing");
        size_t length = rows[i].reported ? strlen(rows[i].reported) : 0;
        // without a newline at the end, only the start is compared
        if (length > 0 && rows[i].reported[length - 1] != '\n')
            drawn.reported[length] = 0;
        assert_text(rows[i].name, drawn.reported, rows[i].reported ? rows[i].reported : "");
        assert_claim(rows[i].name, drawn_byte(&drawn, 32, 32, 0) > 200);
        assert_claim(rows[i].name, drawn_byte(&drawn, 32, 32, 1) < 100);
        drawn_close(&drawn);
    }
}

static int setup(void **state) {
    static char folder[] = "/tmp/petri-faults-XXXXXX";
    *state = folder;
    if (!mkdtemp(folder) || chdir(folder) != 0)
        return 1;
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        FILE *file = fopen(files[i][0], "wb");
        fputs(files[i][1], file);
        fclose(file);
    }
    return 0;
}

static int teardown(void **state) {
    for (size_t i = 0; i < sizeof files / sizeof *files; i++)
        remove(files[i][0]);
    return rmdir(*state);
}

TEST_GROUP(scene_faults) {
    if (!drawn_can_run())
        return GROUP_SKIPPED;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_each_problem_is_reported_once, setup, teardown)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
