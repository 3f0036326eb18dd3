; A suite begins at the end of the line above it.
(suite) @fold
