#!/usr/bin/env bash
# What:      fflate's gunzipSync of a .gz with two members returns neither both nor the first: it returns the beginning of the first member,
#            as many bytes as the last one has, without an error. gzip, zlib of Node.js and fflate's own stream Gunzip return both.
# Versions:  fflate 0.8.3 (npm)
# Seen on:   30 November 2026, Debian 12, x86-64, Node.js 20.20.2
# Matters:   a history or a log that is appended to in pieces (gzip -c >>, bgzip, one member for each process) is such a file, and is cut
#            short on a page.
# Solidus:   its pages unpack raw deflate that Solidus wrote in one piece (inflateSync, web/report/src/blocks.ts), never a .gz.
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

make_modules fflate=0.8.3

said=$(in_node <<'SCRIPT'
import { gunzipSync as ofNode, gzipSync } from "node:zlib";
import { Gunzip, gunzipSync, strFromU8 } from "fflate";

const members = ["time,temperature\n0,973.15\n1,951.20\n", "2,934.80\n"];
const file = new Uint8Array(Buffer.concat(members.map((text) => gzipSync(text))));
const streamed = [];
new Gunzip((part) => streamed.push(...part)).push(file, true);
console.log(`written: ${members.map((text) => text.length).join(" + ")} bytes`);
console.log(`zlib: ${ofNode(file).length} bytes`);
console.log(`fflate's Gunzip: ${streamed.length} bytes`);
console.log(`fflate's gunzipSync: ${gunzipSync(file).length} bytes: ${JSON.stringify(strFromU8(gunzipSync(file)))}`);
SCRIPT
)
expect "$said" <<END
written: 35 + 9 bytes
zlib: 44 bytes
fflate's Gunzip: 44 bytes
fflate's gunzipSync: 9 bytes: "time,temp"
END
