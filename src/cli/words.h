// words.h: questions about the words of a command line before it is parsed.
#pragma once

#include <stdbool.h>

// Returns true if the word is `--name` or begins with `--name=`.
bool word_is_option(const char *word, const char *name);
// Returns true if one of the words, which end with NULL, is this option.
bool words_have_option(char *const *words, const char *name);
// Returns true if a command line, which ends with NULL, reads or writes an archive.
bool words_name_archive(char *const *words);
// Returns true if one of the words is a link (link/pack.h): `#` and data, or a URL that ends so, and no file has
// this name.
bool words_name_link(char *const *words);
