"""Solidus for assistants: a server of the Model Context Protocol over standard input and output.

``solidus mcp FOLDER`` or ``python3 -P -m solidus_casting.mcp FOLDER`` starts it; docs/guide/assistants.md is for its users.
:mod:`.protocol` speaks the protocol, :mod:`.tools` declares the tools, :mod:`.work` does what they promise with the rest of the package,
:mod:`.room` and :mod:`.landlock` keep all of it in one folder.
"""
