"""What an identification tells: its summary, its pictures and its files."""
