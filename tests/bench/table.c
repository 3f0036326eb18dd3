// table.c: see table.h.
#include "table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

Table table_new(const char *title, const Column *columns, size_t column_count) {
    return (Table){.title = title, .columns = columns, .column_count = column_count};
}

void table_free(Table *table) {
    free(table->rows);
    *table = (Table){0};
}

Cell *table_row(Table *table) {
    void *grown = realloc(table->rows, (table->row_count + 1) * sizeof *table->rows);
    if (!grown) {
        fputs("bench: out of memory\n", stderr);
        exit(1);
    }
    table->rows = grown;
    Cell *row = table->rows[table->row_count++];
    for (size_t i = 0; i < TABLE_CELLS; i++)
        row[i] = cell_number(NAN);
    return row;
}

Cell cell_number(double x) {
    return (Cell){.number = x};
}

Cell cell_text(const char *text) {
    Cell cell = {.number = NAN};
    snprintf(cell.text, sizeof cell.text, "%s", text);
    return cell;
}

// Returns the text of a cell: about three digits, integers without a decimal point.
static const char *shown(const Cell *cell, char buffer[TABLE_TEXT]) {
    double x = cell->number, size = fabs(x);
    if (cell->text[0])
        return cell->text;
    if (isnan(x))
        return "-";
    int decimals = size >= 99.95 || x == floor(x) ? 0 : size >= 9.995 ? 1 : size >= 0.9995 ? 2 : size >= 0.0995 ? 3 : 4;
    snprintf(buffer, TABLE_TEXT, "%.*f", decimals, x);
    return buffer;
}

static size_t width_of(const Table *table, size_t column) {
    char buffer[TABLE_TEXT];
    const Column *c = &table->columns[column];
    size_t width = strlen(c->top) > strlen(c->bottom) ? strlen(c->top) : strlen(c->bottom);
    for (size_t i = 0; i < table->row_count; i++) {
        size_t length = strlen(shown(&table->rows[i][column], buffer));
        width = length > width ? length : width;
    }
    return width;
}

static void write_aligned(FILE *file, const char *text, size_t column, size_t width) {
    fprintf(file, column == 0 ? "%-*s" : "  %*s", (int)width, text);
}

void table_write_text(const Table *table, FILE *file) {
    char buffer[TABLE_TEXT];
    size_t width[TABLE_CELLS];
    for (size_t k = 0; k < table->column_count; k++)
        width[k] = width_of(table, k);
    fprintf(file, "\n%s\n\n", table->title);
    for (int line = 0; line < 2; line++) {
        for (size_t k = 0; k < table->column_count; k++)
            write_aligned(file, line == 0 ? table->columns[k].top : table->columns[k].bottom, k, width[k]);
        fputc('\n', file);
    }
    for (size_t i = 0; i < table->row_count; i++) {
        for (size_t k = 0; k < table->column_count; k++)
            write_aligned(file, shown(&table->rows[i][k], buffer), k, width[k]);
        fputc('\n', file);
    }
}

void table_write_markdown(const Table *table, FILE *file) {
    char buffer[TABLE_TEXT];
    fprintf(file, "\n## %s\n\n", table->title);
    for (size_t k = 0; k < table->column_count; k++) {
        const Column *c = &table->columns[k];
        fprintf(file, "| %s%s%s ", c->top, c->top[0] && c->bottom[0] ? " " : "", c->bottom);
    }
    fputs("|\n", file);
    for (size_t k = 0; k < table->column_count; k++)
        fputs(k == 0 ? "|---" : "|---:", file);
    fputs("|\n", file);
    for (size_t i = 0; i < table->row_count; i++) {
        for (size_t k = 0; k < table->column_count; k++)
            fprintf(file, "| %s ", shown(&table->rows[i][k], buffer));
        fputs("|\n", file);
    }
}

// Nothing is quoted, because texts contain no commas and no quotes.
void table_write_csv(const Table *table, FILE *file) {
    for (size_t k = 0; k < table->column_count; k++)
        fprintf(file, "%s%s", k ? "," : "", table->columns[k].name);
    fputc('\n', file);
    for (size_t i = 0; i < table->row_count; i++) {
        for (size_t k = 0; k < table->column_count; k++) {
            const Cell *cell = &table->rows[i][k];
            if (k)
                fputc(',', file);
            if (cell->text[0])
                fputs(cell->text, file);
            else if (!isnan(cell->number))
                fprintf(file, "%.6g", cell->number);
        }
        fputc('\n', file);
    }
}
