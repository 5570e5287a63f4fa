"""How the validations of the paper look."""
