// shader_sources.h: the shaders of lib/gl. embed.sh translates the files in shaders/ to C strings.
#pragma once

extern const char gl_source_adjust[], gl_source_bloom[], gl_source_blur[], gl_source_chromakey[], gl_source_common[],
    gl_source_edges[], gl_source_feedback[], gl_source_flare[], gl_source_kaleid[], gl_source_noise[],
    gl_source_plain[], gl_source_scene[], gl_source_scene_light[], gl_source_scene_texture[], gl_source_scene_through[],
    gl_source_scene_vertex[], gl_source_show[], gl_source_transform[], gl_source_vignette[];
