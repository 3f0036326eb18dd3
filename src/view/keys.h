// keys.h: what keys are called (the names that petri_key takes).
#ifndef PETRI_SRC_KEYS_H
#define PETRI_SRC_KEYS_H

// The key that a character is on: a letter of either case, a digit, a space, a sign of ASCII (+ is on that
// of =); NULL for others.
const char *key_of_character(char character);

#endif
