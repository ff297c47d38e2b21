"""Makes what is handed out: the archive that runs on any Linux, its bill of materials, checksums, notes (./dev release)."""
