"""What values show of themselves in a notebook: small HTML with a sketch in SVG, made without matplotlib."""
