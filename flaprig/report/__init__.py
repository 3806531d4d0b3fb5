"""What people see of a run: tables, pictures, videos and the files that keep them."""
