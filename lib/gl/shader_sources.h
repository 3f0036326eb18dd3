// shader_sources.h: the shaders of lib/gl. embed.sh translates the files in shaders/ to C strings.
#pragma once

#define PICTURE_EFFECT(id, name, scalable, help) extern const char gl_source_##name[];
#include "schema/schema_list.h"

extern const char gl_source_common[], gl_source_plain[], gl_source_scene[], gl_source_scene_group_vertex[],
    gl_source_scene_light[], gl_source_scene_texture[], gl_source_scene_through[], gl_source_scene_vertex[],
    gl_source_show[];
