// canvas3d_list.h: the rows of schema_list.h for three dimensions (spec canvas3d.md). Included by schema_list.h and
// nothing else.
// clang-format off

#define TRANSFORM3D_ROWS(kind) \
    ATTR(kind, TRANSLATE, TRIPLE, NOWHERE, DESCRIBED(0, "0"), "", "move the origin; of these attributes, what is written first is applied first") \
    ATTR(kind, SCALE, TRIPLE, NOWHERE, DESCRIBED(1, "1"), "", "enlarge") \
    ATTR(kind, ROTATE, LIST, NOWHERE, DESCRIBED(0, "0"), "turns", "about z, then y, then x: three numbers, or one for all; four are a quaternion w;x;y;z") \
    ATTR(kind, ROTATE_X, AMOUNT, NOWHERE, IS(0), "turns", "about one axis") \
    ATTR(kind, ROTATE_Y, AMOUNT, NOWHERE, IS(0), "turns", "about one axis") \
    ATTR(kind, ROTATE_Z, AMOUNT, NOWHERE, IS(0), "turns", "about one axis") \
    ATTR(kind, SHEAR_X, AMOUNTS, NOWHERE, IS(0), "", "a;b: x grows by a*y + b*z") \
    ATTR(kind, SHEAR_Y, AMOUNTS, NOWHERE, IS(0), "", "a;b: y grows by a*x + b*z") \
    ATTR(kind, SHEAR_Z, AMOUNTS, NOWHERE, IS(0), "", "a;b: z grows by a*x + b*y") \
    ATTR(kind, MATRIX, LIST, NOWHERE, NONE, "", "16 numbers, by columns")
#define MATERIAL_ROWS(kind) \
    ATTR(kind, COLOR, TRIPLE, TO_GRAPHICS3D(color), INHERITED(0, "0"), "", "the part of light that is thrown back: red;green;blue or grey") \
    ATTR(kind, ROUGHNESS, AMOUNT, TO_GRAPHICS3D(roughness), INHERITED(1, "1"), "", "0 is a mirror; inside it can only become smaller") \
    ATTR(kind, METAL, AMOUNT, TO_GRAPHICS3D(metal), INHERITED(0, "0"), "", "0 to 1") \
    ATTR(kind, IOR, AMOUNT, TO_GRAPHICS3D(ior), INHERITED(1.5, "1.5"), "", "index of refraction: how much the surface shines") \
    ATTR(kind, AO, AMOUNT, TO_GRAPHICS3D(ao), INHERITED(1, "1"), "", "the part of ambient light that reaches the surface") \
    ATTR(kind, EMISSIVE, TRIPLE, TO_GRAPHICS3D(emissive), INHERITED(0, "0"), "", "light of its own") \
    ATTR(kind, TRANSPARENCY, AMOUNT, TO_GRAPHICS3D(transparency), INHERITED(0, "0"), "", "0 to 1; highlights stay") \
    ATTR(kind, TRANSLUCENCY, AMOUNT, TO_GRAPHICS3D(translucency), INHERITED(0, "0"), "", "how deep light shines through") \
    ATTR(kind, COLOR_ID, TEXT, TO_GRAPHICS3D(ids[0]), INHERITED_TEXT(""), "", "id of a picture that lies over the value") \
    ALIAS(kind, TEXTURE_ID, COLOR_ID, "color_id", TEXT, TO_GRAPHICS3D(ids[0]), "") \
    ATTR(kind, METAL_ID, TEXT, TO_GRAPHICS3D(ids[1]), INHERITED_TEXT(""), "", "") \
    ALIAS(kind, METAL_TEXTURE_ID, METAL_ID, "metal_id", TEXT, TO_GRAPHICS3D(ids[1]), "") \
    ATTR(kind, ROUGHNESS_ID, TEXT, TO_GRAPHICS3D(ids[2]), INHERITED_TEXT(""), "", "") \
    ALIAS(kind, ROUGHNESS_TEXTURE_ID, ROUGHNESS_ID, "roughness_id", TEXT, TO_GRAPHICS3D(ids[2]), "") \
    ATTR(kind, AO_ID, TEXT, TO_GRAPHICS3D(ids[3]), INHERITED_TEXT(""), "", "") \
    ALIAS(kind, AO_TEXTURE_ID, AO_ID, "ao_id", TEXT, TO_GRAPHICS3D(ids[3]), "") \
    ATTR(kind, EMISSIVE_ID, TEXT, TO_GRAPHICS3D(ids[4]), INHERITED_TEXT(""), "", "") \
    ALIAS(kind, EMISSIVE_TEXTURE_ID, EMISSIVE_ID, "emissive_id", TEXT, TO_GRAPHICS3D(ids[4]), "") \
    ATTR(kind, TRANSPARENCY_ID, TEXT, TO_GRAPHICS3D(ids[5]), INHERITED_TEXT(""), "", "") \
    ALIAS(kind, TRANSPARENCY_TEXTURE_ID, TRANSPARENCY_ID, "transparency_id", TEXT, TO_GRAPHICS3D(ids[5]), "") \
    ATTR(kind, BORDER, LIST, NOWHERE, INHERITED(0, "the picture's edge"), "", "colour of textures beyond their edges: r;g;b, r;g;b;a or one number; wins over repeat") \
    ATTR(kind, REPEAT, AMOUNTS, NOWHERE, INHERITED(0, "the picture's edge"), "", "whether textures repeat, along u and v")
#define GROUP3D_ROWS(kind) \
    ATTR(kind, MAX_LIGHTS, FINITE_INTEGER, TO_GRAPHICS3D(max_lights), INHERITED(50, "50"), "", "how many lights shine here; those of groups around come last") \
    ATTR(kind, DEPTH_SORT, FLAG, TO_GRAPHICS3D(depth_sort), INHERITED(true, "true"), "", "what is transparent is drawn last, from back to front") \
    ATTR(kind, DEPTH_TEST, FLAG, TO_GRAPHICS3D(depth_test), INHERITED(true, "true"), "", "what is near hides what is far") \
    ATTR(kind, FACE_CULL, FLAG, TO_GRAPHICS3D(face_cull), INHERITED(true, "true"), "", "one side of surfaces is left out") \
    ATTR(kind, CULL_FACE, FACE, TO_GRAPHICS3D(cull_face), INHERITED(FACE_BACK, ":back"), "", "which one") \
    ATTR(kind, COMPOSITE, MIX3D, TO_GRAPHICS3D(composite), INHERITED(MIX3D_OVER, ":over"), "", "how colours combine with what is there")
#define CAMERA_ROWS(kind) \
    ATTR(kind, POSITION, TRIPLE, NOWHERE, DESCRIBED(0, "0;0;half the width"), "", "where the camera is") \
    ALIAS(kind, VIEWPOINT, POSITION, "position", TRIPLE, NOWHERE, "") \
    ATTR(kind, FOCUS, TRIPLE, NOWHERE, DESCRIBED(0, "0"), "", "what it looks at") \
    ATTR(kind, UP, TRIPLE, NOWHERE, DESCRIBED(0, "0;1;0"), "", "what is up in its picture") \
    ATTR(kind, FOV, AMOUNT, TO_GRAPHICS3D(fov), IS(0.25), "turns", "angle of view") \
    ATTR(kind, FOV_REF, FOV_REF, TO_GRAPHICS3D(fov_ref), DESCRIBED(FOV_HORIZONTAL, ":horizontal"), "", "where that angle is measured") \
    ATTR(kind, NEAR, AMOUNT, TO_GRAPHICS3D(near), IS(1), "", "what is nearer is cut off") \
    ATTR(kind, FAR, AMOUNT, TO_GRAPHICS3D(far), DESCRIBED(NAN, "the width"), "", "what is farther is cut off") \
    ATTR(kind, ORTHOGRAPHIC, FLAG, TO_GRAPHICS3D(orthographic), IS(false), "", "without perspective") \
    ATTR(kind, WIDTH, AMOUNT, TO_GRAPHICS3D(width), DESCRIBED(NAN, "the width of the picture"), "", "of the view, without perspective") \
    ATTR(kind, SAMPLES, FINITE_INTEGER, TO_GRAPHICS3D(samples), IS(0), "", "for each pixel, for smooth edges: 2, 4, 8") \
    ATTR(kind, COLORBITS, FINITE_INTEGER, TO_GRAPHICS3D(colorbits), DESCRIBED(0, "the window's"), "", "8, 16 or 32 for each channel") \
    ATTR(kind, FOG_MIN, AMOUNT, TO_GRAPHICS3D(fog_min), IS(0), "", "distance at which fog begins") \
    ATTR(kind, FOG_MAX, AMOUNT, TO_GRAPHICS3D(fog_max), IS(0), "", "distance beyond which there is only fog") \
    ATTR(kind, FOG_COLOR, TRIPLE, TO_GRAPHICS3D(fog_color), IS(0), "", "") \
    ATTR(kind, FOG_CURVE, AMOUNT, TO_GRAPHICS3D(fog_curve), IS(1), "", "its share is raised to 1/this") \
    ATTR(kind, MONOCHROME, FLAG, TO_GRAPHICS3D(monochrome), IS(false), "", "grey") \
    ATTR(kind, TINT, TRIPLE, TO_GRAPHICS3D(tint), IS(1), "", "colours are multiplied by it")
#define SURFACE_ROWS(kind) \
    ATTR(kind, FLAT, FLAG, NOWHERE, IS(false), "", "each triangle by itself: corners are seen") \
    ATTR(kind, SNAP_EDGES, AMOUNT, NOWHERE, DESCRIBED(0.5, "0.5"), "turns", "edges of more than this angle are seen") \
    ATTR(kind, INVERT, FLAG, NOWHERE, IS(false), "", "turned inside out: the inside is seen") \
    ATTR(kind, UV_REMAP, UV_REMAP, NOWHERE, DESCRIBED(REMAP_NONE, "not at all"), "", "how textures are wound around the model")
#define MODEL_ROWS(kind) \
    ATTR(kind, POSITION, TRIPLE, NOWHERE, DESCRIBED(0, "0"), "", "its middle") \
    ATTR(kind, ROTATION, TRIPLE, NOWHERE, DESCRIBED(0, "0"), "turns", "about z, then y, then x") \
    ATTR(kind, SIZE, TRIPLE, NOWHERE, DESCRIBED(1, "1"), "", "along its three axes") \
    ATTR(kind, START, TRIPLE, NOWHERE, DESCRIBED(0, "0"), "", "with end: where its axis begins") \
    ATTR(kind, END, TRIPLE, NOWHERE, NONE, "", "where its axis ends, in place of position, rotation and size") \
    ATTR(kind, RADIUS, AMOUNT, NOWHERE, IS(1), "", "with end") \
    SURFACE_ROWS(kind) \
    MATERIAL_ROWS(kind)

NODE(CANVAS3D, "canvas3d", PICTURE, SCENE3D, "a scene of three dimensions, and the camera that sees it: y up, z towards the camera")
SOURCE_ROWS(CANVAS3D)
ATTR(CANVAS3D, CAMERA_ID, TEXT, NOWHERE, DESCRIBED(0, "its own"), "", "the camera whose view is the picture")
CAMERA_ROWS(CANVAS3D)
TRANSFORM3D_ROWS(CANVAS3D)
GROUP3D_ROWS(CANVAS3D)
MATERIAL_ROWS(CANVAS3D)

NODE(GROUP3D, "group", SCENE3D, SCENE3D, "lights shine, and what is transparent is sorted, within a group")
TRANSFORM3D_ROWS(GROUP3D)
GROUP3D_ROWS(GROUP3D)
MATERIAL_ROWS(GROUP3D)

NODE(TRANSFORM3D, "transform", SCENE3D, SCENE3D, "move, enlarge and turn what is inside")
TRANSFORM3D_ROWS(TRANSFORM3D)

NODE(MATERIAL, "material", SCENE3D, SCENE3D, "what surfaces inside are like")
MATERIAL_ROWS(MATERIAL)

NODE(LIGHT, "light", SCENE3D, NOTHING, "a light: ambient, or by what is given from a direction, a point, a spot or a line")
ATTR(LIGHT, COLOR, TRIPLE, NOWHERE, NONE, "", "may be beyond white, and below 0")
ATTR(LIGHT, POSITION, TRIPLE, NOWHERE, NONE, "", "of a point or a spot")
ATTR(LIGHT, DIRECTION, TRIPLE, NOWHERE, NONE, "", "in which it shines")
ATTR(LIGHT, FOCUS, TRIPLE, NOWHERE, NONE, "", "what a spot shines at")
ATTR(LIGHT, START, TRIPLE, NOWHERE, NONE, "", "of a line")
ATTR(LIGHT, END, TRIPLE, NOWHERE, NONE, "", "of a line")
ATTR(LIGHT, RADIUS, AMOUNT, NOWHERE, IS(0), "", "of a point or a line")
ATTR(LIGHT, OUTER, AMOUNT, NOWHERE, IS(0.25), "turns", "angle of a spot's whole cone")
ATTR(LIGHT, INNER, AMOUNT, NOWHERE, IS(0), "turns", "angle of the cone in which it has its full strength")
ATTR(LIGHT, FALLOFF, QUAD, NOWHERE, DESCRIBED(0, "0;0;1;0"), "", "a;b;c;d: its strength at a distance x is 1/(a + b*x + c*x^2 + d*x^3)")

NODE(CAMERA, "camera", SCENE3D, NOTHING, "a camera; what is missing is that of the canvas3d")
ATTR(CAMERA, ID, TEXT, NOWHERE, NONE, "", "the name by which camera_id finds it, and textures its picture")
ATTR(CAMERA, SECONDARY, FLAG, NOWHERE, IS(false), "", "make its picture, too")
ATTR(CAMERA, SIZE, AMOUNTS, NOWHERE, DESCRIBED(0, "that of the canvas3d"), "pixels", "")
CAMERA_ROWS(CAMERA)

NODE(BOX, "box", SCENE3D, NOTHING, "a cube with edges of 1")
ATTR(BOX, UV_MAP, UV_MAP, NOWHERE, DESCRIBED(UV_STANDARD, ":standard"), "", "whether the faces share a texture or repeat it")
MODEL_ROWS(BOX)

NODE(SPHERE, "sphere", SCENE3D, NOTHING, "a sphere of radius 1")
ATTR(SPHERE, SEGMENTS, FINITE_INTEGER, NOWHERE, IS(64), "", "around it, a multiple of 4")
MODEL_ROWS(SPHERE)

NODE(CYLINDER, "cylinder", SCENE3D, NOTHING, "a cylinder of radius 1 along z, 1 long")
ATTR(CYLINDER, SEGMENTS, FINITE_INTEGER, NOWHERE, IS(64), "", "around it")
MODEL_ROWS(CYLINDER)

NODE(CONE, "cone", SCENE3D, NOTHING, "a cone of radius 1, its tip towards z, 1 high")
ATTR(CONE, SEGMENTS, FINITE_INTEGER, NOWHERE, IS(64), "", "around it")
MODEL_ROWS(CONE)

NODE(MODEL, "model", SCENE3D, NOTHING, "triangles from an OBJ or STL file, or from vectors")
ATTR(MODEL, FILENAME, TEXT, NOWHERE, NONE, "", "")
ATTR(MODEL, VERTICES, LIST, NOWHERE, NONE, "", "x;y;z;x;y;z…")
ATTR(MODEL, FACES, LIST, NOWHERE, NONE, "", "numbers of vertices, three for each triangle, counter-clockwise; without, the convex hull")
ATTR(MODEL, UV, LIST, NOWHERE, NONE, "", "u;v for each vertex")
MODEL_ROWS(MODEL)

#undef TRANSFORM3D_ROWS
#undef MATERIAL_ROWS
#undef GROUP3D_ROWS
#undef CAMERA_ROWS
#undef SURFACE_ROWS
#undef MODEL_ROWS
