// outline.h: paths as lists of lines and curves, and what path effects make of them (spec canvas.md 7).
#ifndef PETRI_DRAW_OUTLINE_H
#define PETRI_DRAW_OUTLINE_H

#include "draw/list.h"

typedef struct OutlinePoint {
    double x;
    double y;
} OutlinePoint;

// PIECE_MOVE, PIECE_LINE, PIECE_CURVE_3 and PIECE_CLOSE; the last of the points is where it ends.
typedef struct OutlinePiece {
    ListPiece kind;
    OutlinePoint points[3];
} OutlinePiece;

typedef struct Outline {
    Arena *arena;
    double fine; // flat enough
    LIST_ARRAY(OutlinePiece) pieces;
} Outline;

// Whether the paint has an effect that changes the path, other than dashes of its lines.
bool outline_has_effect(const List *list, const ListPaint *paint);
// Whether this effect or one in it dashes lines, and so makes another path of them than of what they enclose.
bool outline_has_dashes(const List *list, uint32_t effect);
// What this effect and those in it make of an outline, filled or as lines, in its arena. LIST_NONE: as it is.
Outline outline_apply(const List *list, uint32_t effect, Outline from, bool lines);
// Adds what the list says of a path, its arcs as curves.
void outline_take(Outline *out, const List *list, const ListPath *path);

#endif
