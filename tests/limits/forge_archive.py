#!/usr/bin/env python3
"""forge_archive.py KIND SOURCE TARGET [ARGUMENT...]: writes a copy of an archive that is hard to read.

KIND        ARGUMENT     result
branches    TABLE        interior pages of the table's tree, each of which names the next one hundreds of times
chain       TABLE COLUMN a long value, whose overflow pages are one page that names itself, in a sparse file
distant     TABLE        a row of frame 10^15
wal                      a database with a write-ahead log
journal     FILE         the archive, beside a journal whose transaction belongs to the super-journal FILE
killed                   an archive and its journal in the middle of a transaction that has written many pages
"""
import os
import shutil
import sqlite3
import struct
import sys

HEADER, LEVELS, CHAIN_BYTES, DISTANT = 100, 12, 900_000_000, 10**15
INTERIOR_TABLE, INTERIOR_INDEX, LEAF_INDEX, LEAF_TABLE = 5, 2, 10, 13
JOURNAL_MAGIC = bytes.fromhex("d9d505f920a163d7")


class Pages:
    """The pages of a database. Page 1 is the first."""

    def __init__(self, name):
        with open(name, "rb") as file:
            data = file.read()
        self.size = struct.unpack_from(">H", data, 16)[0]
        self.pages = [bytearray(data[at:at + self.size]) for at in range(0, len(data), self.size)]

    def add(self, page):
        self.pages.append(bytearray(page))
        return len(self.pages)

    def write(self, name, count=None):
        header = self.pages[0]
        struct.pack_into(">I", header, 28, count or len(self.pages))
        header[92:96] = header[24:28]  # the number of pages is valid
        with open(name, "wb") as file:
            file.write(b"".join(self.pages))
            if count:
                file.truncate(count * self.size)


def varint(x):
    if x < 0:  # nine bytes, of which the last has eight bits
        x += 1 << 64
        return bytes(x >> 8 >> 7 * i & 127 | 128 for i in range(7, -1, -1)) + bytes([x & 255])
    digits = [x & 127]
    while x := x >> 7:
        digits.insert(0, x & 127 | 128)
    return bytes(digits)


def read_varint(data, at):
    x = 0
    for _ in range(8):
        x, at = x << 7 | data[at] & 127, at + 1
        if not data[at - 1] & 128:
            return x, at
    x = x << 8 | data[at]
    return x - (1 << 64) * (x >> 63), at + 1


def root_of(name, table):
    if table == "sqlite_schema":
        return 1, True
    database = sqlite3.connect(name)
    root, sql = database.execute("SELECT rootpage, sql FROM sqlite_schema WHERE name = ?", (table,)).fetchone()
    database.close()
    return root, "WITHOUT ROWID" not in sql and "INDEX" not in sql


def page_of_cells(size, kind, cells, right=None):
    """Returns a page with these cells; `right` is the last child of an interior page."""
    page, at = bytearray(size), size
    start = 8 if right is None else 12
    page[0] = kind
    struct.pack_into(">H", page, 3, len(cells))
    if right is not None:
        struct.pack_into(">I", page, 8, right)
    for i, cell in enumerate(cells):
        at -= len(cell)
        page[at:at + len(cell)] = cell
        struct.pack_into(">H", page, start + 2 * i, at)
    struct.pack_into(">H", page, 5, at)
    return page


def forge_branches(source, target, table):
    database = Pages(source)
    root, has_rowids = root_of(source, table)
    leaf = database.pages[root - 1]
    if root == 1:  # the tree follows the header of the database
        count = struct.unpack_from(">H", leaf, HEADER + 3)[0]
        leaf = bytearray(leaf)
        leaf[:8 + 2 * count] = leaf[HEADER:HEADER + 8 + 2 * count]
    child = database.add(leaf)
    if has_rowids:
        kind, rest = INTERIOR_TABLE, varint(1)
    else:  # an interior page of an index also has a row in each cell, here that of the leaf
        kind, at = INTERIOR_INDEX, struct.unpack_from(">H", leaf, 8)[0]
        length, start = read_varint(leaf, at)
        rest = bytes(leaf[at:start + length])
    for _ in range(LEVELS):
        cell = struct.pack(">I", child) + rest
        page = page_of_cells(database.size, kind, [cell] * ((database.size - 12) // (len(cell) + 2) - 1), child)
        child = database.add(page)
    top = database.pages.pop()
    if root == 1:
        count = struct.unpack_from(">H", top, 3)[0] - HEADER
        struct.pack_into(">H", top, 3, count)
        top = database.pages[0][:HEADER] + top[:12 + 2 * count] + top[HEADER + 12 + 2 * count:]
    database.pages[root - 1] = top
    database.write(target)


def rows_of(database, root):
    """Returns rowid and columns' types and bytes of the rows of a table whose tree is one page."""
    page = database.pages[root - 1]
    for i in range(struct.unpack_from(">H", page, 3)[0]):
        at = struct.unpack_from(">H", page, 8 + 2 * i)[0]
        _, at = read_varint(page, at)
        rowid = None
        if page[0] == LEAF_TABLE:
            rowid, at = read_varint(page, at)
        head, types_at = read_varint(page, at)
        types, body = [], at + head
        while types_at < at + head:
            kind, types_at = read_varint(page, types_at)
            types.append(kind)
        columns = []
        for kind in types:
            length = (0, 1, 2, 3, 4, 6, 8, 8, 0, 0)[kind] if kind < 10 else (kind - 12) // 2
            columns.append((kind, bytes(page[body:body + length])))
            body += length
        yield rowid, columns


def forge_chain(source, target, table, column):
    """The table must have few short rows. The first row gets a long value."""
    database = Pages(source)
    root, has_rowids = root_of(source, table)
    usable = database.size
    chain = len(database.pages) + 1
    rowid, columns = next(rows_of(database, root))
    kind = columns[column][0]
    smallest = (usable - 12) * 32 // 255 - 23
    types = [k for k, _ in columns]
    types[column] = 12 + kind % 2 + 2 * CHAIN_BYTES if kind >= 12 else 13 + 2 * CHAIN_BYTES
    head = b"".join(map(varint, types))
    head = varint(len(head) + 1) + head
    before = b"".join(data for _, data in columns[:column])
    total = len(head) + len(before) + CHAIN_BYTES + sum(len(data) for _, data in columns[column + 1:])
    local = smallest + (total - smallest) % (usable - 4)
    largest = usable - 35 if has_rowids else (usable - 12) * 64 // 255 - 23
    local = local if local <= largest else smallest
    cell = varint(total) + (varint(rowid) if has_rowids else b"")
    cell += (head + before).ljust(local, b"1") + struct.pack(">I", chain)
    database.pages[root - 1] = page_of_cells(usable, LEAF_TABLE if has_rowids else LEAF_INDEX, [cell])
    database.add(struct.pack(">I", chain) + b"1" * (usable - 4))
    database.write(target, CHAIN_BYTES // usable + 10)


def forge_distant(source, target, table):
    shutil.copyfile(source, target)
    database = sqlite3.connect(target)
    row = {"digest": "(?1, zeroblob(16))", "input": "(NULL, ?1, 'clock', '1;2;3;0;0;1;5')",
           "keyframe": "(?1, 0, 'x', 'y', 'z')", "file": "(NULL, ?1, 'x.fl', '', NULL)"}[table]
    database.execute(f"INSERT INTO {table} VALUES {row}", (DISTANT,))
    database.commit()
    database.close()


def forge_wal(source, target):
    shutil.copyfile(source, target)
    with open(target, "r+b") as file:
        file.seek(18)
        file.write(b"\2\2")


def forge_journal(source, target, victim):
    shutil.copyfile(source, target)
    database = Pages(source)
    name = os.path.abspath(victim).encode()
    header = JOURNAL_MAGIC + struct.pack(">IIIII", 0, 0, len(database.pages), 512, database.size)
    end = struct.pack(">I", 0x40000000 // database.size + 1) + name + struct.pack(">II", len(name), sum(name))
    with open(target + "-journal", "wb") as file:
        file.write(header.ljust(512, b"\0") + end + JOURNAL_MAGIC)


def forge_killed(source, target):
    work = target + "-work"
    shutil.copyfile(source, work)
    database = sqlite3.connect(work, isolation_level=None)
    database.execute("PRAGMA cache_size = 3")  # changed pages are written before the transaction ends
    database.execute("BEGIN IMMEDIATE")
    database.execute("DELETE FROM digest")
    database.execute("UPDATE keyframe SET state = 'lost'")
    database.execute("INSERT INTO note VALUES (NULL, 1, hex(zeroblob(100000)))")
    for end in "", "-journal":
        shutil.copyfile(work + end, target + end)
    database.execute("ROLLBACK")
    database.close()
    os.unlink(work)


def main():
    kind, source, target, *arguments = sys.argv[1:]
    if kind == "chain":
        arguments[1] = int(arguments[1])
    globals()["forge_" + kind](source, target, *arguments)


main()
