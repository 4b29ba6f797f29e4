"""Maps in an editor: the server of the language server protocol, over standard input and output.

What it knows of a text is in modules without a protocol: `tolerant` reads broken texts, `grammar` walks the schema of
the map language along a path, `names` knows what is declared and referred to where. `server` speaks the protocol.
"""
