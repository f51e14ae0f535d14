"""What the method needs and nothing more: arrays in, records out; it knows no file, no note and no sentence about a plant."""
