// canvas3d_list.h: the rows of schema_list.h for 3-D scenes (spec canvas3d.md). Included only by schema_list.h.
// clang-format off

#define TRANSFORM3D_ROWS(kind) \
    ATTR(kind, TRANSLATE, TRIPLE, NOWHERE, DESCRIBED(0, "0"), "", "move the origin; all transform attributes apply in the order in which they are written") \
    ATTR(kind, SCALE, TRIPLE, NOWHERE, DESCRIBED(1, "1"), "", "scale factors along x, y and z") \
    ATTR(kind, ROTATE, LIST, NOWHERE, DESCRIBED(0, "0"), "turns", "rotate about z, then y, then x: three angles, or one for all axes; four numbers are a quaternion w;x;y;z") \
    ATTR(kind, ROTATE_X, AMOUNT, NOWHERE, IS(0), "turns", "rotate about the x axis") \
    ATTR(kind, ROTATE_Y, AMOUNT, NOWHERE, IS(0), "turns", "rotate about the y axis") \
    ATTR(kind, ROTATE_Z, AMOUNT, NOWHERE, IS(0), "turns", "rotate about the z axis") \
    ATTR(kind, SHEAR_X, AMOUNTS, NOWHERE, IS(0), "", "a;b: a*y + b*z is added to x") \
    ATTR(kind, SHEAR_Y, AMOUNTS, NOWHERE, IS(0), "", "a;b: a*x + b*z is added to y") \
    ATTR(kind, SHEAR_Z, AMOUNTS, NOWHERE, IS(0), "", "a;b: a*x + b*y is added to z") \
    ATTR(kind, MATRIX, LIST, NOWHERE, NONE, "", "a 4 by 4 matrix in column-major order")
#define MATERIAL_ROWS(kind) \
    ATTR(kind, COLOR, TRIPLE, TO_GRAPHICS3D(color), INHERITED(0, "0"), "", "fraction of light that is reflected: red;green;blue or grey") \
    ATTR(kind, ROUGHNESS, AMOUNT, TO_GRAPHICS3D(roughness), INHERITED(1, "1"), "", "0 is a perfect mirror; nodes inside can only reduce the roughness") \
    ATTR(kind, METAL, AMOUNT, TO_GRAPHICS3D(metal), INHERITED(0, "0"), "", "from 0 (not a metal) to 1 (metal)") \
    ATTR(kind, IOR, AMOUNT, TO_GRAPHICS3D(ior), INHERITED(1.5, "1.5"), "", "index of refraction; larger values make the surface shinier") \
    ATTR(kind, AO, AMOUNT, TO_GRAPHICS3D(ao), INHERITED(1, "1"), "", "fraction of ambient light that reaches the surface") \
    ATTR(kind, EMISSIVE, TRIPLE, TO_GRAPHICS3D(emissive), INHERITED(0, "0"), "", "colour of the light that the surface emits") \
    ATTR(kind, TRANSPARENCY, AMOUNT, TO_GRAPHICS3D(transparency), INHERITED(0, "0"), "", "from 0 (opaque) to 1 (only specular highlights are visible)") \
    ATTR(kind, TRANSLUCENCY, AMOUNT, TO_GRAPHICS3D(translucency), INHERITED(0, "0"), "", "distance that light penetrates into the body") \
    ATTR(kind, COLOR_ID, TEXT, TO_GRAPHICS3D(ids[0]), INHERITED_TEXT(""), "", "id of a node or camera whose picture is the texture for color") \
    ALIAS(kind, TEXTURE_ID, COLOR_ID, "color_id", TEXT, TO_GRAPHICS3D(ids[0]), "") \
    ATTR(kind, METAL_ID, TEXT, TO_GRAPHICS3D(ids[1]), INHERITED_TEXT(""), "", "id of a node or camera whose picture is the texture for metal") \
    ALIAS(kind, METAL_TEXTURE_ID, METAL_ID, "metal_id", TEXT, TO_GRAPHICS3D(ids[1]), "") \
    ATTR(kind, ROUGHNESS_ID, TEXT, TO_GRAPHICS3D(ids[2]), INHERITED_TEXT(""), "", "id of a node or camera whose picture is the texture for roughness") \
    ALIAS(kind, ROUGHNESS_TEXTURE_ID, ROUGHNESS_ID, "roughness_id", TEXT, TO_GRAPHICS3D(ids[2]), "") \
    ATTR(kind, AO_ID, TEXT, TO_GRAPHICS3D(ids[3]), INHERITED_TEXT(""), "", "id of a node or camera whose picture is the texture for ao") \
    ALIAS(kind, AO_TEXTURE_ID, AO_ID, "ao_id", TEXT, TO_GRAPHICS3D(ids[3]), "") \
    ATTR(kind, EMISSIVE_ID, TEXT, TO_GRAPHICS3D(ids[4]), INHERITED_TEXT(""), "", "id of a node or camera whose picture is the texture for emissive") \
    ALIAS(kind, EMISSIVE_TEXTURE_ID, EMISSIVE_ID, "emissive_id", TEXT, TO_GRAPHICS3D(ids[4]), "") \
    ATTR(kind, TRANSPARENCY_ID, TEXT, TO_GRAPHICS3D(ids[5]), INHERITED_TEXT(""), "", "id of a node or camera whose picture is the texture for transparency") \
    ALIAS(kind, TRANSPARENCY_TEXTURE_ID, TRANSPARENCY_ID, "transparency_id", TEXT, TO_GRAPHICS3D(ids[5]), "") \
    ATTR(kind, BORDER, LIST, NOWHERE, INHERITED(0, "the colour of the edge"), "", "colour of textures beyond their edges: r;g;b, r;g;b;a or one number; takes precedence over repeat") \
    ATTR(kind, REPEAT, AMOUNTS, NOWHERE, INHERITED(0, "0"), "", "whether textures repeat beyond their edges, along u and v")
#define GROUP3D_ROWS(kind) \
    ATTR(kind, MAX_LIGHTS, FINITE_INTEGER, TO_GRAPHICS3D(max_lights), INHERITED(50, "50"), "", "maximum number of lights in the group; lights of enclosing groups are dropped first") \
    ATTR(kind, DEPTH_SORT, FLAG, TO_GRAPHICS3D(depth_sort), INHERITED(true, "true"), "", "transparent surfaces are drawn last, from back to front") \
    ATTR(kind, DEPTH_TEST, FLAG, TO_GRAPHICS3D(depth_test), INHERITED(true, "true"), "", "near surfaces hide far ones") \
    ATTR(kind, FACE_CULL, FLAG, TO_GRAPHICS3D(face_cull), INHERITED(true, "true"), "", "draw only one side of each surface") \
    ATTR(kind, CULL_FACE, FACE, TO_GRAPHICS3D(cull_face), INHERITED(FACE_BACK, ":back"), "", "the side that face_cull does not draw") \
    ATTR(kind, COMPOSITE, MIX3D, TO_GRAPHICS3D(composite), INHERITED(MIX3D_OVER, ":over"), "", "how colours are combined with those already drawn") \
    ATTR(kind, VERTEX, TEXT, NOWHERE, NONE, "", "GLSL source that replaces the vertex shader; not inherited") \
    ATTR(kind, FRAGMENT, TEXT, NOWHERE, NONE, "", "GLSL source that replaces the fragment shader; not inherited")
#define CAMERA_ROWS(kind) \
    ATTR(kind, POSITION, TRIPLE, NOWHERE, DESCRIBED(0, "0;0;half the width of the picture"), "", "position of the camera") \
    ALIAS(kind, VIEWPOINT, POSITION, "position", TRIPLE, NOWHERE, "") \
    ATTR(kind, FOCUS, TRIPLE, NOWHERE, DESCRIBED(0, "0"), "", "point that the camera looks at") \
    ATTR(kind, UP, TRIPLE, NOWHERE, DESCRIBED(0, "0;1;0"), "", "direction that points up in the picture") \
    ATTR(kind, FOV, AMOUNT, TO_GRAPHICS3D(fov), IS(0.25), "turns", "angle of view") \
    ATTR(kind, FOV_REF, FOV_REF, TO_GRAPHICS3D(fov_ref), DESCRIBED(FOV_HORIZONTAL, ":horizontal"), "", "direction in which fov is measured") \
    ATTR(kind, NEAR, AMOUNT, TO_GRAPHICS3D(near), IS(1), "", "distance below which surfaces are clipped") \
    ATTR(kind, FAR, AMOUNT, TO_GRAPHICS3D(far), DESCRIBED(NAN, "the width of the picture"), "", "distance beyond which surfaces are clipped") \
    ATTR(kind, ORTHOGRAPHIC, FLAG, TO_GRAPHICS3D(orthographic), IS(false), "", "project without perspective") \
    ATTR(kind, WIDTH, AMOUNT, TO_GRAPHICS3D(width), DESCRIBED(NAN, "the width of the picture"), "", "width of the view, if orthographic") \
    ATTR(kind, SAMPLES, FINITE_INTEGER, TO_GRAPHICS3D(samples), IS(0), "", "samples per pixel, for smooth edges: 2, 4 or 8") \
    ATTR(kind, COLORBITS, FINITE_INTEGER, TO_GRAPHICS3D(colorbits), DESCRIBED(0, "the colorbits of the window"), "", "bits per channel: 8, 16 or 32") \
    ATTR(kind, FOG_MIN, AMOUNT, TO_GRAPHICS3D(fog_min), IS(0), "", "distance at which fog begins") \
    ATTR(kind, FOG_MAX, AMOUNT, TO_GRAPHICS3D(fog_max), IS(0), "", "distance beyond which there is only fog") \
    ATTR(kind, FOG_COLOR, TRIPLE, TO_GRAPHICS3D(fog_color), IS(0), "", "colour of the fog") \
    ATTR(kind, FOG_CURVE, AMOUNT, TO_GRAPHICS3D(fog_curve), IS(1), "", "the fraction of fog is raised to the power 1/fog_curve") \
    ATTR(kind, MONOCHROME, FLAG, TO_GRAPHICS3D(monochrome), IS(false), "", "render in grey") \
    ATTR(kind, TINT, TRIPLE, TO_GRAPHICS3D(tint), IS(1), "", "factor for all colours")
#define SURFACE_ROWS(kind, snap, snap_text) \
    ATTR(kind, FLAT, FLAG, NOWHERE, IS(false), "", "flat shading: each triangle has its own normal") \
    ATTR(kind, SNAP_EDGES, AMOUNT, NOWHERE, DESCRIBED(snap, snap_text), "turns", "edges stay sharp where the normals of their faces differ by more than this; with 0.5, no edge is sharp") \
    ATTR(kind, INVERT, FLAG, NOWHERE, IS(false), "", "turn the model inside out, so that its inside is visible") \
    ATTR(kind, UV_REMAP, UV_REMAP, NOWHERE, DESCRIBED(REMAP_NONE, "no remapping"), "", "how textures are mapped onto the model")
#define PLACED_ROWS(kind, snap, snap_text) \
    ATTR(kind, POSITION, TRIPLE, NOWHERE, DESCRIBED(0, "0"), "", "centre of the model") \
    ATTR(kind, ROTATION, TRIPLE, NOWHERE, DESCRIBED(0, "0"), "turns", "rotation about z, then y, then x") \
    ATTR(kind, SIZE, TRIPLE, NOWHERE, DESCRIBED(1, "1"), "", "scale along x, y and z") \
    ATTR(kind, START, TRIPLE, NOWHERE, DESCRIBED(0, "0"), "", "start of the axis; ignored unless end is set") \
    ATTR(kind, END, TRIPLE, NOWHERE, NONE, "", "end of the axis; replaces position, rotation and size") \
    ATTR(kind, RADIUS, AMOUNT, NOWHERE, IS(1), "", "radius around the axis; ignored unless end is set") \
    SURFACE_ROWS(kind, snap, snap_text) \
    MATERIAL_ROWS(kind)
#define MODEL_ROWS(kind) PLACED_ROWS(kind, 0.5, "0.5")
#define SOLID_ROWS(kind) PLACED_ROWS(kind, 0.05, "0.05")
#define BLEND_ROWS(kind) \
    ATTR(kind, SMOOTH, AMOUNT, NOWHERE, IS(0), "", "in distance fields: width of the smooth transition between members") \
    ATTR(kind, FILLET, AMOUNT, NOWHERE, IS(0), "", "in distance fields: radius of rounded edges between members; ignored if smooth is set") \
    ATTR(kind, CHAMFER, AMOUNT, NOWHERE, IS(0), "", "in distance fields: size of bevelled edges between members; ignored if smooth or fillet is set")
#define TRIM_ROWS(kind) \
    ATTR(kind, ORIGIN, TRIPLE, NOWHERE, DESCRIBED(0, "0"), "", "a point of the plane") \
    ATTR(kind, NORMAL, TRIPLE, NOWHERE, NONE, "", "direction from the plane to the part that is cut away") \
    BLEND_ROWS(kind) \
    SOLID_ROWS(kind)

NODE(CANVAS3D, "canvas3d", PICTURE, SCENE3D, "a 3-D scene and its default camera: y up, z towards the camera")
SOURCE_ROWS(CANVAS3D)
ATTR(CANVAS3D, CAMERA_ID, TEXT, NOWHERE, DESCRIBED(0, "the canvas3d itself"), "", "id of the camera that renders the picture")
CAMERA_ROWS(CANVAS3D)
TRANSFORM3D_ROWS(CANVAS3D)
GROUP3D_ROWS(CANVAS3D)
MATERIAL_ROWS(CANVAS3D)

NODE(GROUP3D, "group", SCENE3D, SCENE3D, "a render group, within which lights shine and transparent surfaces are sorted")
TRANSFORM3D_ROWS(GROUP3D)
GROUP3D_ROWS(GROUP3D)
MATERIAL_ROWS(GROUP3D)

NODE(TRANSFORM3D, "transform", SCENE3D, SCENE3D, "move, scale and rotate the nodes inside")
TRANSFORM3D_ROWS(TRANSFORM3D)

NODE(MATERIAL, "material", SCENE3D, SCENE3D, "material of the surfaces inside")
MATERIAL_ROWS(MATERIAL)

NODE(LIGHT, "light", SCENE3D, NOTHING, "a light; its attributes determine whether it is an ambient, point, directional, spot or line light")
ATTR(LIGHT, COLOR, TRIPLE, NOWHERE, NONE, "", "colour of the light; it can be brighter than white, or negative")
ATTR(LIGHT, POSITION, TRIPLE, NOWHERE, NONE, "", "position of a point or spot light")
ATTR(LIGHT, DIRECTION, TRIPLE, NOWHERE, NONE, "", "direction in which the light shines")
ATTR(LIGHT, FOCUS, TRIPLE, NOWHERE, NONE, "", "the point that a spot light is directed at")
ATTR(LIGHT, START, TRIPLE, NOWHERE, NONE, "", "start of a line light")
ATTR(LIGHT, END, TRIPLE, NOWHERE, NONE, "", "end of a line light")
ATTR(LIGHT, RADIUS, AMOUNT, NOWHERE, IS(0), "", "radius of a point or line light")
ATTR(LIGHT, OUTER, AMOUNT, NOWHERE, IS(0.25), "turns", "angle of the whole cone that a spot light illuminates")
ATTR(LIGHT, INNER, AMOUNT, NOWHERE, IS(0), "turns", "angle of the cone in which a spot light has its full strength")
ATTR(LIGHT, FALLOFF, QUAD, NOWHERE, DESCRIBED(0, "0;0;1;0"), "", "a;b;c;d: the strength at a distance x is 1/(a + b*x + c*x^2 + d*x^3)")

NODE(CAMERA, "camera", SCENE3D, NOTHING, "a camera; missing attributes are taken from the canvas3d")
ATTR(CAMERA, ID, TEXT, NOWHERE, NONE, "", "name by which camera_id and textures refer to this camera")
ATTR(CAMERA, SECONDARY, FLAG, NOWHERE, IS(false), "", "render the view of this camera for use as a texture")
ATTR(CAMERA, SIZE, AMOUNTS, NOWHERE, DESCRIBED(0, "the size of the canvas3d"), "pixels", "size of the camera's picture")
CAMERA_ROWS(CAMERA)

NODE(BOX, "box", SCENE3D, NOTHING, "a cube with edges of length 1")
ATTR(BOX, UV_MAP, UV_MAP, NOWHERE, DESCRIBED(UV_STANDARD, ":standard"), "", "whether the faces share one texture, or each face shows all of it")
MODEL_ROWS(BOX)

NODE(SPHERE, "sphere", SCENE3D, NOTHING, "a sphere of radius 1")
ATTR(SPHERE, SEGMENTS, FINITE_INTEGER, NOWHERE, IS(64), "", "number of segments around the sphere, rounded up to a multiple of 4")
MODEL_ROWS(SPHERE)

NODE(CYLINDER, "cylinder", SCENE3D, NOTHING, "a cylinder of radius 1 and length 1 along z")
ATTR(CYLINDER, SEGMENTS, FINITE_INTEGER, NOWHERE, IS(64), "", "number of segments around the axis")
MODEL_ROWS(CYLINDER)

NODE(CONE, "cone", SCENE3D, NOTHING, "a cone of radius 1 and height 1, its apex towards +z")
ATTR(CONE, SEGMENTS, FINITE_INTEGER, NOWHERE, IS(64), "", "number of segments around the axis")
MODEL_ROWS(CONE)

NODE(MODEL, "model", SCENE3D, NOTHING, "triangles from an OBJ, STL, PLY or OFF file, or from vectors")
ATTR(MODEL, FILENAME, TEXT, NOWHERE, NONE, "", "")
ATTR(MODEL, VERTICES, LIST, NOWHERE, NONE, "", "x;y;z;x;y;z…")
ATTR(MODEL, FACES, LIST, NOWHERE, NONE, "", "indices of vertices, three per triangle, counter-clockwise (default: the convex hull)")
ATTR(MODEL, UV, LIST, NOWHERE, NONE, "", "u;v for each vertex")
ATTR(MODEL, REPAIR, FLAG, NOWHERE, IS(false), "", "join equal vertices, turn all triangles outwards and fill holes")
MODEL_ROWS(MODEL)

NODE(UNION, "union", SCENE3D, SCENE3D, "a solid: all models inside, joined")
BLEND_ROWS(UNION)
SOLID_ROWS(UNION)

NODE(INTERSECT, "intersect", SCENE3D, SCENE3D, "a solid: what all models inside have in common")
BLEND_ROWS(INTERSECT)
SOLID_ROWS(INTERSECT)

NODE(DIFFERENCE, "difference", SCENE3D, SCENE3D, "a solid: the first model inside without the others")
BLEND_ROWS(DIFFERENCE)
SOLID_ROWS(DIFFERENCE)

NODE(TRIM, "trim", SCENE3D, SCENE3D, "a solid: the models inside, joined and cut off at a plane")
TRIM_ROWS(TRIM)

NODE(SLICE, "slice", SCENE3D, SCENE3D, "another name for trim")
TRIM_ROWS(SLICE)

NODE(SDF, "sdf", SCENE3D, SCENE3D, "the surface of a distance field, which the members determine")
ATTR(SDF, MINIMUM, TRIPLE, NOWHERE, DESCRIBED(-1, "-1"), "", "lower corner of the box that contains the surface")
ALIAS(SDF, MIN, MINIMUM, "minimum", TRIPLE, NOWHERE, "")
ATTR(SDF, MAXIMUM, TRIPLE, NOWHERE, DESCRIBED(1, "1"), "", "upper corner of the box that contains the surface")
ALIAS(SDF, MAX, MAXIMUM, "maximum", TRIPLE, NOWHERE, "")
ATTR(SDF, RESOLUTION, AMOUNT, NOWHERE, DESCRIBED(0, "1/64 of the box's longest side"), "", "distance between samples of the field")
ATTR(SDF, FUNCTION, FUNCTION, NOWHERE, NONE, "", "called with a point x;y;z, it returns the distance from the surface; replaces the members")
BLEND_ROWS(SDF)
SOLID_ROWS(SDF)

NODE(MIX, "mix", SCENE3D, SCENE3D, "in distance fields: a shape between those of the members")
ATTR(MIX, WEIGHTS, LIST, NOWHERE, DESCRIBED(1, "1"), "", "weights of the members, repeated if there are more members")

#undef TRANSFORM3D_ROWS
#undef MATERIAL_ROWS
#undef GROUP3D_ROWS
#undef CAMERA_ROWS
#undef SURFACE_ROWS
#undef PLACED_ROWS
#undef MODEL_ROWS
#undef SOLID_ROWS
#undef TRIM_ROWS
#undef BLEND_ROWS
