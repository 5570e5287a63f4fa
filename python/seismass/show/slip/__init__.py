"""How slip demand looks."""
