"""An animation as a page, a picture or a film."""
