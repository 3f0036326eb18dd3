// texts.h: the shaders of this room, whose files are in shaders/: embed.sh makes them part of the library.
#ifndef PETRI_GL_TEXTS_H
#define PETRI_GL_TEXTS_H

extern const char gl_text_adjust[], gl_text_bloom[], gl_text_blur[], gl_text_chromakey[], gl_text_common[],
    gl_text_edges[], gl_text_feedback[], gl_text_flare[], gl_text_kaleid[], gl_text_noise[], gl_text_plain[],
    gl_text_scene[], gl_text_scene_light[], gl_text_scene_texture[], gl_text_scene_through[], gl_text_scene_vertex[],
    gl_text_show[], gl_text_transform[], gl_text_vignette[];

#endif
