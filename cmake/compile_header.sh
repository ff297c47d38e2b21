#!/bin/sh
# Runs a compiler (its command line, ccache in front) with the precompiled header that it writes out of the way: ccache lets the
# compiler preprocess the source first, which would take the old header for the text of all that it holds, so that the result of other
# headers came from the cache.
for word in "$@"; do
  case $last:$word in -o:*.gch | -o:*.pch) rm -f "$word" ;; esac
  last=$word
done
# A header differs by its comments alone too: the compiler knows a file that must not be read twice by all of its text. So the result
# comes from the cache where every file is the same, not where the preprocessor makes the same of them.
export CCACHE_DEPEND=1
exec "$@"
