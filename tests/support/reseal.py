"""reseal.py ARCHIVE: computes the SHA-256 sums of an archive again, as src/archive/README.md defines them."""
import hashlib
import sqlite3
import struct
import sys

def pack(value):
    if isinstance(value, int):
        return struct.pack("<q", value)
    value = value if isinstance(value, bytes) else value.encode()
    return struct.pack("<q", len(value)) + value

database = sqlite3.connect(sys.argv[1])
before, sums = -2, None
for frame, given, setup, state in database.execute("SELECT frame, given, setup, state FROM keyframe ORDER BY frame").fetchall():
    data = sums.encode() if sums else b"".join(
        pack(value) for table in ("meta ORDER BY key", "parameter ORDER BY name")
        for row in database.execute(f"SELECT * FROM {table}") for value in row)
    for columns in ("frame, name, sha256 FROM file", "frame, kind, payload FROM input", "frame, text FROM note", "frame, digest FROM digest"):
        order = "frame" if "digest FROM" in columns else "id"
        for row in database.execute(f"SELECT {columns} WHERE frame > ? AND frame <= ? ORDER BY {order}", (before, frame)):
            data += b"".join(map(pack, row))
    data += b"".join(map(pack, (frame, given, setup, state)))
    before, sums = frame, hashlib.sha256(data).hexdigest()
    database.execute("UPDATE keyframe SET sha256 = ? WHERE frame = ?", (sums, frame))
database.commit()
