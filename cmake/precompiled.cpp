/// Nothing: a library of this one file keeps the precompiled headers.
