"""What a system is in itself: zeros, indices, kernel rows, delays, behaviour and fault space."""
