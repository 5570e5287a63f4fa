"""How results of design methods look."""
